"""Desk: session, worker, exporter and events of one studio, put together."""

import functools
import shutil
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from relieffab.errors import InputError
from relieffab.job import looking, milling, styles
from relieffab.job.settings import Chosen
from relieffab.progress import Progress
from relieffab.studio import controls, looks, upload, warm
from relieffab.studio.ask import Ask
from relieffab.studio.children import Children
from relieffab.studio.events import Events
from relieffab.studio.exporting import MODEL, Exporter, State
from relieffab.studio.model import Model
from relieffab.studio.preview import Preview
from relieffab.studio.session import Session
from relieffab.studio.sheet import Sheet
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

    def open(self, file: Path, **of_file: str) -> None:
        """Open a model's file, with the settings that are of that file alone.

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
        self.session.open(model, **of_file)

    def open_mask(self, file: Path) -> str:
        """Open a mask of the picture that is open, and choose it.

        Raises
        ------
        InputError
            If it cannot be read or does not fit.
        """
        of = self.session.model
        own = self.session.place_of_mask(upload.safe_name(file.name))
        try:
            shutil.copyfile(file, own)
            mask = upload.parse_mask(own, self.children, of)
            if of is not self.session.model:
                raise SupersededError
        except BaseException:
            shutil.rmtree(own.parent, ignore_errors=True)
            raise
        return self.session.take_mask(mask)

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
        model = self.session.model
        if model is None:
            raise InputError("no model is open", hint="drop a model file on the page")
        return (
            looks.sheet_frame(model) if isinstance(model, Sheet) else looks.mesh_frame(model.shown)
        )

    def preview(self, asked: Mapping[str, Any]) -> "Future[bytes]":
        """Show layers, and the relief if that is wanted, too."""
        before = self.session.texts
        ask, facts = self._settled("preview", asked)
        wanted = asked.get("want", ["layers", "relief"])
        fine = asked.get("fine") is True
        preview = self.session.fine if fine else self.session.preview

        def work(progress: Progress) -> bytes:
            preview.seconds = {}
            view = preview.view(ask, progress)
            solved = None
            if "relief" in wanted:
                # Marks take more pixels and time than the hand waits for.
                solve = preview.marked if fine else preview.relief
                solved = solve(view, ask.job, progress)
            notes = [*ask.model.notes, *view.notes]
            if solved and solved.marks is None and not styles.style_of(ask.job).plain:
                notes.append("marks are shown when the hand rests")
            idle = controls.idle(view.kind, bent=ask.job.round is not None)
            more = {"seconds": preview.seconds, "notes": notes, "idle": idle}
            return looks.preview_frame(view, solved, ask.job, {**facts, **more})

        # With other settings, whatever else is in work is void.
        drops = () if self.session.texts == before else ("panel", "toolpaths")
        return self.worker.ask("preview", work, drops=drops)

    def panel(self, asked: Mapping[str, Any]) -> "Future[bytes]":
        """Show the panel."""
        ask, facts = self._settled("panel", asked)

        def work(progress: Progress) -> bytes:
            panel = self._carving(ask).panel(ask, progress)
            return looks.panel_frame(panel, facts)

        return self.worker.ask("panel", work)

    def toolpaths(self, asked: Mapping[str, Any]) -> "Future[bytes]":
        """Show programs, what they leave and how long they take."""
        ask, facts = self._settled("toolpaths", asked)

        def work(progress: Progress) -> bytes:
            start = time.perf_counter()
            preview = self._carving(ask)
            solved = preview.marked(preview.view(ask, progress), ask.job, progress)
            tried = self.session.trial.carry_out(solved, ask.job, progress)
            seconds = {"toolpaths": time.perf_counter() - start}
            return looks.toolpaths_frame(tried, {**facts, "seconds": seconds})

        return self.worker.ask("toolpaths", work, report=self._reporter("toolpaths"))

    def carved(self, at: float) -> "Future[bytes]":
        """Show the stock at a moment of the last programs."""
        return self.worker.ask("carved", lambda _: looks.carved_frame(self.session.trial, at))

    def _carving(self, ask: Ask) -> Preview:
        """Choose what panels and programs are tried on: marks need what is fine enough."""
        return self.session.preview if styles.style_of(ask.job).plain else self.session.fine

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
        masks = [ask.mask.file] if ask.mask else []
        return self.exporter.start(self.session.job_file(MODEL), ask.model.file, *masks)


def _described(model: Model | Sheet | None) -> dict[str, Any] | None:
    if model is None:
        return None
    return {
        "name": model.name,
        "kind": model.kind,
        "about": model.about,
        "notes": list(model.notes),
        "idle": controls.idle(model.kind),
        **({} if isinstance(model, Sheet) else {"triangles": model.triangles, "up": model.up}),
    }
