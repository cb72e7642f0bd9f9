"""_motion.py: pictures that move: lists of frames, and the turntable."""
import os

from ._core import BadValue, call, path_bytes, run, shown, text_bytes, text_of
from ._native import ffi, lib
from ._options import CHANGES, OTHERS, Options
from ._picture import Picture
from ._scene import Scene, draw, load_scene, pair_of, render


class Frames(list):
    """Pictures of one size, one after the other: `Frames(pictures).save("turn.gif")`."""

    def encode(self, format: str = "png", *, fps: float = 24, loops: int = 0) -> bytes:
        """Returns the bytes of a moving picture: png, webp or gif. `loops` is the number of repetitions; 0: forever."""
        if not self:
            raise BadValue("Frames: found no picture, expected at least one")
        height, width = self[0].shape[:2]
        params = ffi.new("lam_animation_params *", {"frames_per_second": fps, "loops": loops})
        made = ffi.gc(call(lib.lam_animation_make, text_bytes("format", format), width, height, params), lib.lam_animation_free)
        for frame in self:
            image, _pixels = frame.view(Picture)._image()
            call(lib.lam_animation_add, made, image, ffi.NULL)
        out = ffi.new("lam_bytes *")
        call(lib.lam_animation_finish, made, ffi.NULL, out)
        try:
            return ffi.buffer(out.data, out.size)[:]
        finally:
            lib.lam_bytes_free(out)

    def save(self, path: "str | os.PathLike[str]", *, fps: float = 24, loops: int = 0) -> None:
        """Writes a .gif, .webp or .png file; the file is complete or is not written."""
        format = text_of(lib.lam_animation_format(path_bytes(path)))
        if not format:
            raise BadValue("Frames.save: found %s, expected a file that ends in .gif, .webp or .png" % shown(os.fspath(path)))
        data = self.encode(format, fps=fps, loops=loops)
        call(lib.lam_bytes_save, ffi.new("lam_bytes *", {"data": ffi.from_buffer(data), "size": len(data)}), path_bytes(path))

    def _repr_png_(self):
        return self.encode("png") if self else None


def turntable(model: "Model", frames: int = 36, size: "int | tuple[int, int] | None" = None, *, name: "str | None" = None, **options) -> Frames:
    """Turns a model once around its up axis. Returns its Frames, the frames of `lambent MODEL --turntable`. The model is read once; the keyword
    arguments are those of `lambent.render`, except `rotate`."""
    if not isinstance(frames, int) or not 2 <= frames <= 100000:
        raise BadValue("turntable: found %s frames, expected a whole number from 2 to 100000" % shown(frames))
    if isinstance(model, Scene):
        raise BadValue("turntable: found a Scene, expected a model as for lambent.render; render it with lambent.views(\"ring:%d\")" % frames)
    chosen, wanted = Options(options, None, {**OTHERS, **CHANGES}), None if size is None else pair_of(size)
    if "rotate" in chosen:
        raise BadValue("turntable: 'rotate' is set for each frame")

    def work(task):
        scene, made = load_scene(model, chosen, name, task), Frames()
        axis = scene.up.strip("-")
        call(lib.lam_scene_mark, scene._handle)
        for index in range(frames):
            chosen.given["rotate"] = "%s:%r" % (axis, 360 * index / frames)
            made.append(draw(scene, chosen, wanted, task, changes=True))
            call(lib.lam_scene_reset, scene._handle)
        return made
    return run(work, chosen.control)


turntable.__doc__ += " " + render.__doc__[render.__doc__.index("Raises Error"):render.__doc__.index("Keyword arguments")].strip()
