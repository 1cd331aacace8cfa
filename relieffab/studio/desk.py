"""Desk: session, worker, exporter and events of one studio, put together."""

import functools
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.job import looking, milling, reliefs
from relieffab.job.settings import Chosen
from relieffab.progress import Progress
from relieffab.studio import controls, looks, upload, warm
from relieffab.studio.children import Children
from relieffab.studio.events import Events
from relieffab.studio.exporting import MODEL, Exporter, State
from relieffab.studio.model import Model
from relieffab.studio.session import Ask, Session
from relieffab.studio.worker import SupersededError, Work, Worker


class Desk:
    """Everything of one person's studio; `close` leaves nothing behind.

    Parameters
    ----------
    chosen : mapping of Chosen
        The settings to begin with.
    output : Path
        Where jobs go.
    """

    def __init__(self, chosen: Mapping[str, Chosen], output: Path) -> None:
        self.session = Session(chosen)
        self.worker = Worker()
        self.children = Children()
        self.events = Events()
        self._opened = 0
        self._newest: tuple[str, dict[str, int]] = "", {}
        self.warming = False
        self.exporter = Exporter(output, self.children, self.events.publish)

    def stop(self) -> None:
        """Let go of all who wait: listeners, and whatever is being worked out anywhere."""
        self.events.close()
        self.worker.stop()
        self.exporter.give_up()
        self.children.close()

    def close(self) -> None:
        """End all work and processes, and take scratch files away."""
        self.stop()
        self.exporter.cancel()
        self.worker.close()
        self.session.close()

    def warm(self) -> None:
        """Compile what previews take, while nothing else is asked."""
        self.warming = True
        self._warm_on(iter(warm.steps()))

    def _warm_on(self, steps: Iterator[Work], done: "Future[None] | None" = None) -> None:
        """Take the next step; after a fault, or the last, no more."""
        step = None if done and done.exception() else next(steps, None)
        if step is None:
            self.warming = False
            self.events.publish({"warm": None})
            return
        taken = self.worker.ask("warm", step, report=self._reporter("warm"))
        taken.add_done_callback(functools.partial(self._warm_on, steps))

    def open(self, file: Path, *, up: str = "") -> None:
        """Open a model's file; `up` is its axis that points up, guessed if not given.

        Raises
        ------
        InputError
            If it cannot be read.
        SupersededError
            If another was opened meanwhile.
        """
        self._opened += 1
        number = self._opened
        model = upload.parse(file, self.children)
        if number != self._opened:
            raise SupersededError
        self.session.open(model, up=up)

    def open_scarab(self) -> None:
        """Open the toolkit's own scarab, as a file like any other."""
        import trimesh

        from relieffab.subject import scarab

        file = self.session.new_place() / "scarab.obj"
        trimesh.Trimesh(*scarab(), process=False).export(file)
        self.open(file, up=looking.SCARAB_UP)

    def state(self) -> dict[str, Any]:
        """Say what is open, and what may be chosen."""
        return {
            "model": _described(self.session.model),
            "settings": self.session.texts,
            **self._offered,
            "warming": self.warming,
            "export": self.exporter.state,
            "limit_bytes": upload.LARGEST,
        }

    @functools.cached_property
    def _offered(self) -> dict[str, Any]:
        return {"controls": controls.controls(), **controls.listed()}

    def mesh(self) -> bytes:
        """Show the model."""
        if self.session.model is None:
            raise InputError("no model is open", hint="drop a model file on the page")
        return looks.mesh_frame(self.session.model.shown)

    def preview(self, asked: Mapping[str, Any]) -> "Future[bytes]":
        """Show layers, and the relief if that is wanted, too."""
        before = self.session.texts
        ask, facts = self._settled("preview", asked)
        wanted = asked.get("want", ["layers", "relief"])
        preview = self.session.fine if asked.get("fine") is True else self.session.preview

        def work(progress: Progress) -> bytes:
            preview.seconds = {}
            view = preview.view(ask.model, ask.job, progress)
            solved = preview.relief(view, ask.job, progress) if "relief" in wanted else None
            more = {"seconds": preview.seconds, "notes": list(ask.model.shown.notes)}
            carving = reliefs.carving_of(ask.job)
            return looks.preview_frame(view, solved, carving, {**facts, **more})

        # With other settings, whatever else is in work is void.
        drops = () if self.session.texts == before else ("panel", "toolpaths")
        return self.worker.ask("preview", work, drops=drops)

    def panel(self, asked: Mapping[str, Any]) -> "Future[bytes]":
        """Show the panel."""
        ask, facts = self._settled("panel", asked)

        def work(progress: Progress) -> bytes:
            panel = self.session.preview.panel(ask.model, ask.job, progress)
            return looks.panel_frame(panel, facts)

        return self.worker.ask("panel", work)

    def toolpaths(self, asked: Mapping[str, Any]) -> "Future[bytes]":
        """Show programs, what they leave and how long they take."""
        ask, facts = self._settled("toolpaths", asked)

        def work(progress: Progress) -> bytes:
            start = time.perf_counter()
            preview = self.session.preview
            view = preview.view(ask.model, ask.job, progress)
            solved = preview.relief(view, ask.job, progress)
            tried = self.session.trial.carry_out(solved, ask.job, progress)
            seconds = {"toolpaths": time.perf_counter() - start}
            return looks.toolpaths_frame(tried, {**facts, "seconds": seconds})

        return self.worker.ask("toolpaths", work, report=self._reporter("toolpaths"))

    def carved(self, at: float) -> "Future[bytes]":
        """Show the stock at a moment of the last programs."""
        return self.worker.ask("carved", lambda _: looks.carved_frame(self.session.trial, at))

    def _settled(self, kind: str, asked: Mapping[str, Any]) -> tuple[Ask, dict[str, Any]]:
        """Take an ask's settings, if it is the newest of its page.

        Raises
        ------
        SupersededError
            If a later one came in first.
        """
        number = asked.get("ask")
        if isinstance(number, int):
            page = str(asked.get("page", ""))[:40]
            if page != self._newest[0]:
                self._newest = page, {}
            if number < self._newest[1].get(kind, number):
                raise SupersededError
            self._newest[1][kind] = number
        ask = self.session.settle(asked.get("settings", {}))
        size = {"size_mm": list(ask.job.size), "thickness_mm": ask.job.thickness}
        return ask, {"ask": number, **size, "depth_mm": ask.job.depth}

    def _reporter(self, name: str) -> Progress:
        last = 0.0

        def report(stage: str, done: float, total: float, unit: str = "") -> None:
            nonlocal last
            if (now := time.monotonic()) - last > 0.1:
                last = now
                fact = {"stage": stage, "done": done, "total": total, "unit": unit}
                self.events.publish({name: fact})

        return report

    def export(self, settings: Mapping[str, Any]) -> State:
        """Begin the job."""
        ask = self.session.settle(settings)
        milling.check(ask.job)
        return self.exporter.start(self.session.job_file(MODEL), ask.model.file)


def _described(model: Model | None) -> dict[str, Any] | None:
    if model is None:
        return None
    return {
        "name": model.name,
        "triangles": model.triangles,
        "notes": list(model.shown.notes),
        "up": model.up,
    }
