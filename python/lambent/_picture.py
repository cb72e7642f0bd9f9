"""_picture.py: pictures as NumPy arrays with methods to show and save them."""
import os
import sys
import tempfile
import webbrowser

import numpy as np

from ._core import BadValue, call, path_bytes, shown, text_bytes
from ._fields import choose, words_of
from ._native import ffi, lib


class Picture(np.ndarray):
    """A picture: a read-only NumPy array, height × width × 4 (red, green, blue, alpha; row 0 is the top).

    8-bit pictures are sRGB-encoded and not premultiplied; float pictures (`floats=True`) are linear and premultiplied. A part of a picture, such as
    picture[100:200, 50:150], is also a picture. `array.view(lambent.Picture)` turns another array into a picture."""

    raw = False  # the numbers are not sRGB colours
    camera = None  # the Camera of the picture
    warnings = ()  # warnings about problems of the model
    comment = ""  # the comment of PNG files: the number of paths of light, and their noise

    def __array_finalize__(self, other):
        for name in ("raw", "camera", "warnings", "comment"):
            setattr(self, name, getattr(other, name, getattr(Picture, name)))

    def __array_wrap__(self, array, context=None, return_scalar=False):
        """The results of calculations with pictures are plain numbers and arrays."""
        return np.asarray(array)[()]

    def _image(self):
        """A lam_image of the pixels, and the array that owns them."""
        formats = {np.dtype(np.uint8): lib.LAM_RGBA8, np.dtype(np.float32): lib.LAM_RGBA32F}
        if self.ndim != 3 or self.shape[2] != 4 or self.dtype not in formats:
            raise BadValue("Picture: found an array of %s numbers of the type %s, expected height x width x 4 of uint8 or float32" % (
                "x".join(map(str, self.shape)), self.dtype))
        pixels = np.ascontiguousarray(self)
        return ffi.new("lam_image *", {"width": self.shape[1], "height": self.shape[0], "format": formats[self.dtype],
                                       "pixels": ffi.from_buffer(pixels)}), pixels

    def _params(self, compress, quality):
        if not isinstance(quality, (int, np.integer)) or not 0 <= quality <= 100:
            raise BadValue("quality: found %s, expected a whole number from 0 to 100" % shown(quality))
        comment = ffi.new("char[]", self.comment.encode())
        params = ffi.new("lam_save_params *", {"raw": self.raw, "compress": choose("compress", words_of("lam_compress"), compress), "quality": quality})
        if self.comment:
            params.comment = comment
        return params, comment

    def encode(self, format: str = "png", *, compress: str = "fast", quality: int = 0) -> bytes:
        """Returns the bytes of a file: png, ppm, jpg or webp with 8 bits, pfm or exr with floats. `quality` of jpg and webp is 1 to 100."""
        out, (image, _pixels), (params, _comment) = ffi.new("lam_bytes *"), self._image(), self._params(compress, quality)
        call(lib.lam_image_encode, image, text_bytes("format", format), params, out)
        try:
            return ffi.buffer(out.data, out.size)[:]
        finally:
            lib.lam_bytes_free(out)

    def png(self) -> bytes:
        """Returns the bytes of a PNG file, which are the same as the program's for the same picture."""
        return self.encode("png")

    def save(self, path: "str | os.PathLike[str]", *, compress: str = "fast", quality: int = 0) -> None:
        """Writes a file in the format of its extension; the file is complete or is not written."""
        (image, _pixels), (params, _comment) = self._image(), self._params(compress, quality)
        call(lib.lam_image_save, image, path_bytes(path), params)

    @property
    def hash(self) -> str:
        """The hash of the PNG file, as in the program's journals and reports: "xxh64:…"."""
        png = self.png()
        return "xxh64:%016x" % lib.xxh64_of(png, len(png))

    @property
    def pixel_hash(self) -> str:
        """The hash of the pixels, as `lambent hash` writes it: "pixels:…". Only for 8-bit pictures with red, green, blue and alpha."""
        if self.dtype != np.uint8 or self.ndim != 3 or self.shape[2] != 4:
            raise BadValue("pixel_hash: found a picture of %s with the shape %s, expected 8 bits, red, green, blue and alpha" % (self.dtype, self.shape))
        pixels = self.tobytes()
        return "pixels:%016x" % lib.xxh64_of(pixels, len(pixels))

    def diff(self, other: "Picture") -> "dict[str, float]":
        """Compares with a picture of the same size and type, as `lambent diff` does: the mean and the largest difference of a channel, …"""
        (a, _a), (b, _b), found = self._image(), other.view(Picture)._image(), ffi.new("lam_difference *")
        call(lib.lam_image_compare, a, b, found)
        return {name: getattr(found, name) for name, field in ffi.typeof("lam_difference").fields if field.type.kind == "primitive"}

    def show(self) -> None:
        """Shows the picture: in the notebook, or in the browser."""
        ipython = sys.modules.get("IPython")
        if ipython and ipython.get_ipython():
            return ipython.display.display(self)
        with tempfile.NamedTemporaryFile(prefix="lambent-", suffix=".png", delete=False) as file:
            file.write(self.png())
        webbrowser.open("file://" + file.name)

    def _repr_png_(self):
        return self.png() if self.ndim == 3 and self.shape[2] == 4 and self.dtype == np.uint8 and self.size else None
