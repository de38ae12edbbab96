# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures and animations of contact problems, for a first look."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np

from contactx._host.checks import described, is_number
from contactx._host.drawing import Scene, View, draw, gather, import_pyvista
from contactx._host.files import check_path, make_folder
from contactx._host.parallel.reduce import agreed

if TYPE_CHECKING:
    from contactx.contact import Contact
    from contactx.problem import ContactProblem

_STILLS = (".png", ".jpg")
_MOVING = (".gif", ".mp4")


def plot(
    contacts: Sequence[Contact],
    path: str | Path | None,
    scale: float,
    camera: Sequence[float] | None,
) -> None:
    """Draw contacts; see ``Contact.plot``."""
    _check(scale, camera)
    comm = contacts[0].discrete.halo.comm
    path = None if path is None else _prepared(path, _STILLS, comm)
    scene = gather(contacts, scale)
    with agreed(comm):
        if scene is None:
            return
        view = View([scene], camera)
        name = f" of {contacts[0].name}" if len(contacts) == 1 and contacts[0].name else ""
        plotter = draw(
            scene,
            view,
            scene.limits,
            title=f"contact pressure{name}",
            note=_note(scale),
            off_screen=path is not None,
        )
        if path is None:
            plotter.show()
        else:
            plotter.screenshot(path)
        plotter.close()


def animate(
    path: str | Path,
    problem: ContactProblem,
    *,
    scale: float = 1.0,
    fps: float = 10.0,
    camera: Sequence[float] | None = None,
) -> Animation:
    """Make a film of the deformed bodies and the pressures of all contacts, by PyVista.

    A picture of each time is drawn as ``Contact.plot`` does, from one place and in the colours of
    one range, once the film is closed::

        with cx.animate("run.gif", problem) as film:
            for step in cx.LoadSteps(problem, 20, update=update):
                film.write(step.t)

    It is also closed where an error ends the steps. All ranks take part; rank 0 draws.

    Args:
        path: File with the suffix ``.gif``, or ``.mp4``, which takes the packages imageio and
            imageio-ffmpeg. One of this name is replaced; its folder is made.
        problem: The problem, whose contacts and obstacles are shown.
        scale: Factor of the displacement.
        fps: Pictures a second.
        camera: Direction from the bodies to the viewer in 3D, shape (3,).

    Returns:
        What takes the times.

    Raises:
        ImportError: If PyVista is not installed, or what the film takes.
        OSError: If the folder cannot be made.
        TypeError: If an argument is of another kind.
        ValueError: If the suffix is another one, or a number is out of its range.
    """
    return Animation(path, problem, scale, fps, camera)


class Animation:
    """A film of a problem, made by ``animate``."""

    def __init__(
        self,
        path: str | Path,
        problem: ContactProblem,
        scale: float,
        fps: float,
        camera: Sequence[float] | None,
    ):
        """Check the arguments, which are those of ``animate``."""
        contacts = getattr(problem, "contacts", None)
        if not contacts:
            raise TypeError(f"problem is {described(problem)}: give a contactx.ContactProblem")
        _check(scale, camera)
        if not is_number(fps) or not 0 < fps <= 100:
            kind = ValueError if is_number(fps) else TypeError
            raise kind(f"fps is {described(fps)}: give a number of pictures a second, up to 100")
        self._contacts = list(contacts)
        self._comm = self._contacts[0].discrete.halo.comm
        self._path = _prepared(path, _MOVING, self._comm)
        self._scale, self._fps, self._camera = scale, fps, camera
        self._scenes: list[tuple[float, Scene]] = []
        self._closed = False

    def __enter__(self) -> Animation:
        """Use the film in a with statement."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the film."""
        if error is None:
            self.close()
        else:
            # Other ranks may not come by, and the error is what counts
            self._closed = True
            with suppress(Exception):
                self._draw()

    def write(self, t: float) -> None:
        """Take the current state; all ranks must take part.

        Args:
            t: Time or load factor.

        Raises:
            RuntimeError: If the film is closed.
            TypeError: If t is no number.
        """
        if self._closed:
            raise RuntimeError(f"the film {self._path} is closed: write before that")
        if not is_number(t):
            raise TypeError(f"t is {described(t)}: give a number")
        scene = gather(self._contacts, self._scale)
        if scene is not None:
            self._scenes.append((float(t), scene))

    def close(self) -> None:
        """Draw the film; nothing happens if it was closed, or no time was written.

        Raises:
            OSError: If the file cannot be written, on all ranks.
        """
        if self._closed:
            return
        self._closed = True
        with agreed(self._comm):
            self._draw()

    def _draw(self) -> None:
        if not self._scenes:
            return
        scenes = [scene for _, scene in self._scenes]
        view = View(scenes, self._camera)
        low, high = np.transpose([scene.limits for scene in scenes])
        limits = float(low.min()), float(high.max())
        frames = []
        for t, scene in self._scenes:
            plotter = draw(scene, view, limits, note=f"t = {t:.4g}   {_note(self._scale)}")
            frames.append(np.asarray(plotter.screenshot(return_img=True)))
            plotter.close()
        if self._path.suffix == ".gif":
            first, *rest = map(importlib.import_module("PIL.Image").fromarray, frames)
            duration = round(1000 / self._fps)
            first.save(self._path, save_all=True, append_images=rest, duration=duration, loop=0)
        else:
            # Pixels in blocks of two are what any player takes
            even = [frame[: len(frame) // 2 * 2] for frame in frames]
            writer = _imageio().get_writer(self._path, fps=self._fps, macro_block_size=2)
            with writer:
                for frame in even:
                    writer.append_data(frame)


def _imageio() -> Any:
    """The package that writes .mp4.

    Raises:
        ImportError: If it, or its encoder, is not installed.
    """
    try:
        importlib.import_module("imageio_ffmpeg")
        return importlib.import_module("imageio.v2")
    except ImportError as error:
        raise ImportError(
            "path ends in .mp4, which needs imageio and imageio-ffmpeg: pip install "
            "imageio imageio-ffmpeg, or give a .gif"
        ) from error


def _prepared(path: Any, suffixes: Sequence[str], comm: Any) -> Path:
    """Check the path of a picture and what it takes, and make its folder; all ranks take part."""
    file = check_path("path", path)
    if file.suffix not in suffixes:
        raise ValueError(f"path ends in {file.suffix!r}: give one of {', '.join(suffixes)}")
    with agreed(comm):
        if comm.rank == 0:
            import_pyvista()
            if file.suffix == ".mp4":
                _imageio()
            make_folder("path", file)
    return file


def _check(scale: Any, camera: Any) -> None:
    """Check how a picture is to be drawn.

    Raises:
        TypeError: If an argument is of another kind.
        ValueError: If a number is not finite, or the camera has no direction.
    """
    if not is_number(scale):
        raise TypeError(f"scale is {described(scale)}: give a number")
    if not np.isfinite(scale):
        raise ValueError(f"scale is {scale}: give a finite number")
    if camera is None:
        return
    if np.ndim(camera) != 1 or not all(map(is_number, camera)):
        raise TypeError(f"camera is {described(camera)}: give three numbers, a direction")
    if len(camera) != 3 or not np.isfinite(camera).all() or not any(camera):
        raise ValueError(f"camera is {camera}: give three numbers that are not all zero")


def _note(scale: float) -> str:
    return "" if scale == 1 else f"displacement times {scale:g}"
