# Print lines of more than 110 columns. Fail if there is one.
#
#   LC_ALL=C awk -f tools/check/lines.awk FILES
{
    columns = $0
    gsub(/[\200-\277]/, "", columns) # UTF-8 continues a character by these bytes.
    if (length(columns) > 110) {
        print FILENAME ":" FNR ": the line has " length(columns) " columns, more than 110"
        bad = 1
    }
}
END { exit bad }
