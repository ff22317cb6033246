"""Errors and sentences for the user."""

TOOL = "hair-convert"

# Exit statuses, equal to those of the other tools.
EXIT_OK, EXIT_RUNTIME, EXIT_USAGE, EXIT_INPUT = 0, 1, 2, 4


class InputError(Exception):
    """A file that cannot be used. The text is one sentence without the name of the file."""


class UsageError(Exception):
    """Arguments that cannot be used."""


class MissingPackage(Exception):
    """A Python package that a format needs and that is not installed."""


def escape(text):
    """Return text in which control characters, such as those of a hostile name, are escaped."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in str(text))


def find_reason(error, limit=200):
    """Return the reason in an exception's text, as one line of at most `limit` characters.

    Errors of USD end in the reason in quotes, and those of Alembic in a line of its own.
    """
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    line = lines[-1] if lines else type(error).__name__
    if " : '" in line:
        line = line.split(" : '", 1)[1].rstrip("'")
    return line if len(line) <= limit else line[:limit] + "..."


class Report:
    """A list of sentences about what a conversion changed or could not keep."""

    def __init__(self):
        self.sentences = []

    def say(self, sentence):
        """Add a sentence. A repeated sentence is kept once."""
        if sentence not in self.sentences:
            self.sentences.append(sentence)

    def lose(self, name, because):
        """Say that an attribute is not kept."""
        self.say(f"{name} is not kept, because {because}")
