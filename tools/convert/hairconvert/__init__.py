"""hair-convert converts strand hair between USD, Alembic, .hair, .tfx, .data and OBJ."""

__version__ = "1.0"
