"""Draws catalogues: models from object stores, lists and folders, with the isolated worker of the program `lambent` (docs/catalogue.md).

`draw(rows)` draws a list of rows in this process; `on_dask(client, rows)` with the workers of a Dask scheduler."""
from .drawing import draw, draw_each  # noqa: F401
from .engine import on_dask  # noqa: F401
from .stores import Problem  # noqa: F401
