"""Lambent turns 3D models into correctly lit pictures: the same bytes on every machine, without a graphics card.

>>> import lambent
>>> picture = lambent.render("teapot", 64)
>>> picture.shape, picture.dtype.name
((64, 64, 4), 'uint8')
>>> picture.save("/tmp/teapot.png")
"""
from ._core import (BadModel, BadValue, CannotRead, CannotWrite, Cancelled, Error, FileNotFound, LimitReached, OutOfMemory, TimeLimit, Unsupported, text_of)
from ._fields import Camera, Light, Material, views
from ._mesh import Mesh
from ._native import lib as _lib
from ._object import Object, Picked
from ._motion import Frames, turntable
from ._picture import Picture
from ._scene import Scene, load, render

__version__ = text_of(_lib.lam_version())
__all__ = ["render", "load", "turntable", "views", "Scene", "Object", "Picked", "Mesh", "Material", "Light", "Camera", "Picture", "Frames", "Error", "BadValue", "CannotRead", "FileNotFound", "BadModel",
           "Unsupported", "LimitReached", "OutOfMemory", "TimeLimit", "CannotWrite", "Cancelled"]
for _name in __all__:  # so that error messages and help show the public names of the classes
    getattr(__import__(__name__), _name).__module__ = __name__
