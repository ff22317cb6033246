# bash completion for hair-capture, hair-view, hair-groom and hair-bench. The words come from the
# --help of the tool, so that they are those of the version that is installed.
_hair_complete()
{
    local tool=$1 word=$2 previous=$3 words
    local help
    help=$("$tool" --help 2>/dev/null) || return 0
    COMPREPLY=()
    # The shell splits KEY=VALUE at the sign.
    [ "$previous" != = ] || return 0
    case $previous in
    --set)
        words=$(sed -n '/^Settings for/,$s/^  \([a-z][a-z0-9_.]*\) .*/\1=/p' <<<"$help")
        compopt -o nospace
        ;;
    --scene | --style | --motion)
        local title=${previous#--}
        words=$(sed -n "s/^${title^}s[^:]*: //p" <<<"$help")
        ;;
    *)
        case $word in
        -*) words=$(grep -o '^  --[a-z-]*' <<<"$help") ;;
        *)
            # The first words of lines are suites of hair-bench, and second words commands of hair-groom.
            [ "$COMP_CWORD" != 1 ] ||
                words=$(sed -n '/^Settings for/q; s/^  hair-[a-z]* \([a-z]\{1,\}\) .*/\1/p; s/^  \([a-z]\{1,\}\)  .*/\1/p' <<<"$help")
            ;;
        esac
        ;;
    esac
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    return 0
}
complete -o default -F _hair_complete hair-capture hair-view hair-groom hair-bench
