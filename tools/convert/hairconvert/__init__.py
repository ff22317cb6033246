"""hair-convert converts strand hair between USD, Alembic, .groom, .hair, .tfx, .data and OBJ."""

__version__ = "1.0"
