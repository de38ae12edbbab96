# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Loads that grow in steps, cut back where a step fails."""

from __future__ import annotations

import logging
import operator
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from copy import copy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from mpi4py import MPI

import numpy as np
from rich.table import Table

from contactx import cpp as core
from contactx._host.callbacks import Interrupts
from contactx._host.checkpoint.checkpoint import Checkpoint
from contactx._host.checkpoint.snapshot import Snapshot
from contactx._host.checks import check_switch, described, is_number
from contactx._host.display import Show, progress_bar, show_text
from contactx._host.files import check_path, make_folder
from contactx._host.parallel.reduce import agreed
from contactx.errors import ConvergenceError
from contactx.problem import ContactProblem
from contactx.report import Report, render
from dolfinx import fem

_logger = logging.getLogger("contactx.steps")


class LoadSteps:
    """Solves a problem step after step while t goes from 0 to 1, or to ``t_end``.

    Example::

        def update(t):
            top.g.value[...] = -0.3 * t


        for step in cx.LoadSteps(problem, 10, update=update):
            material.commit()

    With friction the answer depends on the steps, to first order: half the step has about half the
    error, so compare with a run of twice as many. A step has one direction of slip: end one where
    the path turns; see theory/friction of the manual.

    A step that does not converge is halved. Halved steps grow back: once the steps since have taken
    as many linear solves as the failure did, the next is twice as long, but no given t is passed
    over. A step starts from an extrapolation of the last one, where that is nearer a solution. The
    loop sees accepted steps only; its body runs between them, so it may update a material's
    history. A failed attempt leaves u, contacts and history as they were, bit for bit. After a
    break, or an error that was caught, another loop over the same object goes on after the last
    accepted step. An accepted step that the body was not given, since ``output`` failed, comes
    first.

    On several ranks all of them run the loop. What ``update``, ``output`` or the solve raises on
    one rank is raised on all of them. There are two errors on a single rank that leave the others
    waiting, which cannot be prevented: one in the loop's body, and one in ``update`` or ``output``
    while the others are inside a collective call of that function. Each rank writes its
    share of a checkpoint, and rank 0 shows progress; a run can be restarted on any other number of
    ranks.
    """

    def __init__(
        self,
        problem: ContactProblem,
        steps: int | Sequence[float],
        update: Callable[[float], object],
        *,
        history: Sequence[fem.Function] = (),
        output: Callable[[Step], object] | None = None,
        checkpoint: str | Path | None = None,
        restart: str | Path | None = None,
        t_end: float | None = None,
        max_cuts: int = 6,
        easy: int | None = None,
        log: str | Path | None = None,
        progress: bool = True,
    ):
        """Create the steps; nothing is solved before the loop starts.

        Args:
            problem: The problem.
            steps: Number of equal steps, or the t at which each ends, increasing in (0, t_end].
            update: Function of t that sets loads and Dirichlet values. It is called before every
                attempt; after a failure that ends the loop with the last accepted t, 0 if there is
                none; and at a restart with the t of the file.
            history: Functions that belong to the state of a step, such as plastic strains. They are
                written to checkpoints, read from them, and what ``update`` does to them is undone
                when its attempt fails. On several ranks a checkpoint has those of Lagrange spaces
                of degree 1 and 2, mixed ones of them, quadrature and discontinuous spaces, as the
                rank has them that owns them.
            output: Called with each accepted step, before the loop's body.
            checkpoint: File to write once the loop's body has ended for an accepted step. The last
                one stays whole if writing fails.
            restart: Such a file to go on from. The problem must be made as it was then, and
                continues to the same answer.
            t_end: Where the last step ends, in the user's time; 1 if None.
            max_cuts: How often a given step may be halved.
            easy: Linear solves up to which a step is followed by a longer one; None for the rule
                above.
            log: Text file with a line for each attempt: step, attempt, t, its length, linear
                solves, nodes in contact and those that slip, residual and its bound, seconds, and
                why it has failed. A line is on disk once its attempt has ended; a restarted run
                goes on in the same file. The same lines go to the logger "contactx.steps" of
                Python's ``logging``, at level INFO.
            progress: Whether to show a progress bar, and the table of steps at the end.

        Raises:
            FileNotFoundError: If there is no file to restart from.
            TypeError: If an argument is of another kind.
            ValueError: If an argument is out of its range, or the file to restart from is damaged
                or of another problem; nothing has changed then. On several ranks also if arguments
                differ between them, or a checkpoint cannot hold the space of a history.
        """
        if not isinstance(problem, ContactProblem):
            raise TypeError(f"problem must be a ContactProblem, not {type(problem).__name__}")
        self._comm = comm = problem.displacement.function_space.mesh.comm
        with agreed(comm):
            _check_functions(update, output, history)
            check_switch("progress", progress)
            self._plan = make_plan(steps, max_cuts, easy, t_end)
            self._checkpoint = None if checkpoint is None else check_path("checkpoint", checkpoint)
            restarted = None if restart is None else check_path("restart", restart)
            self._log = None if log is None else check_path("log", log)
            for name, path in {"checkpoint": self._checkpoint, "log": self._log}.items():
                if path is not None and comm.rank == 0:
                    make_folder(name, path)
        plan = self._plan.given, self._plan.max_cuts, self._plan.easy
        _check_same(comm, plan, self._checkpoint, restart, len(history), output is None, self._log)
        self._problem = problem
        self._update = update
        self._history = [*history, *problem.beside]
        self._output = output
        self._progress = progress and comm.rank == 0
        self._rows: list[Row] = []
        # Accepted, but an interrupt came before the loop's body, which must have each step
        self._unseen: Step | None = None
        self._state: Checkpoint | None = None
        if checkpoint is not None or restart is not None:
            self._state = Checkpoint(problem, self._history)
        if restarted is not None:
            self._restart(restarted)
        if self._log is not None:
            with agreed(comm):
                if comm.rank == 0:
                    with self._log.open("w" if restarted is None else "a") as file:
                        file.write(f"{core.step_log_heading()}\n")

    @property
    def t(self) -> float:
        """Last accepted t, 0 before the first step."""
        return self._plan.t

    def table(self) -> str:
        """Make a table of the accepted steps.

        Returns:
            The table as plain text, a row a step.
        """
        return table(self._rows)

    def save(self, path: str | Path) -> None:
        """Write a checkpoint of the last accepted step; all ranks must take part.

        Args:
            path: The file, of which each rank writes its share. One of this name is replaced when
                the new one is whole.

        Raises:
            OSError: If it cannot be written.
            ValueError: If the path is a folder, or on several ranks a history is of a space that
                cannot be saved.
        """
        with agreed(self._comm):
            if self._comm.rank == 0:
                make_folder("path", Path(path))
        if self._state is None:
            self._state = Checkpoint(self._problem, self._history)
        table = np.array(self._rows, dtype=np.float64).ravel()
        steps = {"given": np.array(self._plan.given), "place": self._plan.place, "table": table}
        self._state.write(Path(path), steps)

    def __iter__(self) -> Iterator[Step]:
        """Take the steps that are left.

        Yields:
            Accepted steps.

        Raises:
            ConvergenceError: If a step fails although it has been cut to the shortest one.
        """
        if self._plan.finished and self._unseen is None:
            return
        with ExitStack() as stack:
            show: Show = lambda *_: None  # noqa: E731
            with agreed(self._comm):
                if self._progress:
                    # Nothing collective: ranks may end a loop at other times
                    stack.callback(lambda: show_text(self.table()))
                    bar = progress_bar(self._problem, self.t, self._plan.given[-1])
                    show = stack.enter_context(bar)
            while self._unseen is not None or not self._plan.finished:
                step = self._unseen or self._take_step(show)
                with agreed(self._comm):
                    show(self.t, f"step {step.index}")
                    if self._output is not None:
                        self._output(step)
                self._unseen = None
                yield step
                # The body may have updated the history
                if self._checkpoint is not None:
                    self.save(self._checkpoint)

    def _take_step(self, show: Show) -> Step:
        """Attempt shorter and shorter steps until one is accepted."""
        before = self._snapshot()
        begin = last = time.perf_counter()
        index, plan, cuts, discarded = len(self._rows) + 1, copy(self._plan), 0, 0
        with Interrupts() as interrupts:
            while True:
                text = f"step {index} to t = {plan.next:.6g}" + (f", cut {cuts}x" if cuts else "")
                updated = False
                try:
                    interrupts.allow()
                    with agreed(self._comm):
                        show(self.t, text)
                        self._update(plan.next)
                    updated = True
                    self._problem.set_attempt(plan.attempt())
                    self._problem.solve()
                    interrupts.wait()
                    report, now = self._problem.report, time.perf_counter()
                    self._write((index, cuts + 1), plan.next, now - last, report)
                    report.discarded += discarded
                    step = Step(index, plan.next, report)
                    row = make_row(step, now - begin)
                    plan.accept(report.iterations)
                    self._rows, self._plan, self._unseen = [*self._rows, row], plan, step
                except ConvergenceError as error:
                    interrupts.wait()
                    before.restore()
                    end, now = plan.next, time.perf_counter()
                    self._write((index, cuts + 1), end, now - last, error.report)
                    last = now
                    spent = error.report.iterations + error.report.discarded
                    if not plan.cut(spent):
                        error.report.discarded += discarded
                        error.add_note(
                            f"No step from t = {self.t:.6g} converged; the last attempt, to t = "
                            f"{end:.6g}, was the shortest that max_cuts = {plan.max_cuts} "
                            "allows. Where a structure buckles or snaps, dynamics leads on "
                            "(manual: howto/snap)"
                        )
                        interrupts.allow()
                        self._update_again(error)
                        raise
                    discarded += spent
                    cuts += 1
                    continue
                except BaseException as error:
                    interrupts.wait()
                    before.restore()
                    interrupts.allow()
                    if updated:
                        self._update_again(error)
                    raise
                return step

    def _write(self, number: tuple[int, int], end: float, seconds: float, report: Report) -> None:
        """Write an attempt to the log.

        Args:
            number: Of the step, and of the attempt at it.
            end: Where the attempt ends.
            seconds: Wall time.
            report: Its report, which counts no other attempt at the step yet.
        """
        with agreed(self._comm):
            if self._comm.rank != 0:
                return
            step, attempt = number
            last = report.history[-1] if report.history else None
            line = core.step_log_line(
                step=step,
                attempt=attempt,
                start=self.t,
                end=end,
                solves=report.iterations + report.discarded,
                closed=last.closed if last else 0,
                slipping=report.slipping,
                residual=last.residual if last else np.nan,
                tolerance=last.tolerance if last else np.nan,
                seconds=seconds,
                failure="" if report.converged else report.reason,
            )
            _logger.info("%s", line)
            if self._log is not None:
                with self._log.open("a") as file:
                    file.write(f"{line}\n")

    def _snapshot(self) -> Snapshot:
        return self._problem.snapshot(self._history)

    def _update_again(self, error: BaseException) -> None:
        """Set the loads of the last accepted step, whatever that raises."""
        try:
            with agreed(self._comm):
                self._update(self.t)
        except Exception as second:
            error.add_note(f"update({self.t:.6g}), which sets the loads back, failed: {second!r}")

    def _restart(self, path: Path) -> None:
        assert self._state is not None
        before = self._snapshot()
        try:
            try:
                state = self._state.read(path)
                steps, plan = state.steps, copy(self._plan)
                if not {"given", "place"} <= steps.keys():
                    raise ValueError("it has no load steps")
                plan.load(steps["given"], steps["place"])
                self._problem.find_rigid_modes()
                self._state.apply(state)
            except ValueError as error:
                raise ValueError(
                    f"cannot restart from {path}: {error}. Give a checkpoint of this problem, or "
                    "leave restart out (manual: errors/restart-refused)"
                ) from error
            with agreed(self._comm):
                self._update(plan.t)
        except BaseException:
            before.restore()
            raise
        # A program in C++ writes no table
        table = steps.get("table", np.zeros(0)).reshape(-1, len(Row._fields))
        self._rows = [Row(*row) for row in table.tolist()]
        self._plan = plan


def _check_functions(update: Any, output: Any, history: Any) -> None:
    if not callable(update):
        raise TypeError(f"update must be a function of t, not {update!r}")
    if output is not None and not callable(output):
        raise TypeError(f"output must be a function of a step, not {output!r}")
    if isinstance(history, fem.Function):
        raise TypeError("history must be a list of functions: write history=[function]")
    if not isinstance(history, Sequence):
        raise TypeError(f"history must be a list of functions, not {type(history).__name__}")
    for function in history:
        if not isinstance(function, fem.Function):
            raise TypeError(f"history holds a {type(function).__name__}: give fem.Functions")


def _check_same(comm: MPI.Comm, *arguments: Any) -> None:
    """Check that ranks take the same steps and files, or they would wait for each other."""
    first = comm.bcast(arguments)
    with agreed(comm):
        if arguments != first:
            raise ValueError(
                f"rank {comm.rank} has other steps, files, history or output than rank 0: give "
                "all ranks the same"
            )


@dataclass(frozen=True)
class Step:
    """An accepted step.

    Attributes:
        index: Number of the step; 1 is the first one.
        t: Where it ends.
        report: Report of its solve.
    """

    index: int
    t: float
    report: Report = field(repr=False)

    @property
    def iterations(self) -> int:
        """Linear solves; those of cut attempts are in ``report.discarded``."""
        return self.report.iterations


class Row(NamedTuple):
    """A line of the table.

    Attributes:
        t: Where the step ends.
        iterations: Linear solves.
        discarded: Linear solves of the attempts that were cut.
        closed: Slave nodes in contact.
        seconds: Wall time, with the attempts that were cut.
    """

    t: float
    iterations: float
    discarded: float
    closed: float
    seconds: float


def make_row(step: Step, seconds: float) -> Row:
    """Line of an accepted step."""
    report = step.report
    return Row(step.t, report.iterations, report.discarded, report.history[-1].closed, seconds)


def table(rows: Sequence[Row]) -> str:
    """Text table of accepted steps."""
    result = Table("step", "t", "iterations", "discarded", "closed", "seconds")
    for index, row in enumerate(rows, start=1):
        result.add_row(
            str(index),
            f"{row.t:.6g}",
            f"{row.iterations:.0f}",
            f"{row.discarded:.0f}",
            f"{row.closed:.0f}",
            f"{row.seconds:.2f}",
        )
    return render(result)


def make_plan(
    steps: int | Sequence[float], max_cuts: int, easy: int | None = None, t_end: float | None = None
) -> core.StepPlan:
    """Make a plan of what a user gives.

    Args:
        steps: Number of equal steps, or the t of each.
        max_cuts: How often a given step may be halved.
        easy: Iterations up to which an accepted step counts as easy.
        t_end: Where equal steps end, 1 if None; the largest t of a list.

    Raises:
        TypeError: If an argument is of another kind.
        ValueError: If a number is out of its range or the t do not increase.
    """
    if t_end is not None:
        if not is_number(t_end):
            raise TypeError(f"t_end is {described(t_end)}: give a number")
        if not (np.isfinite(t_end) and t_end > 0):
            raise ValueError(f"t_end is {t_end}: give a finite number above 0")
    end = 1.0 if t_end is None else float(t_end)
    max_cuts = _integer("max_cuts", max_cuts, 0, 40)
    easy = None if easy is None else _integer("easy", easy, 0)
    if np.ndim(steps) == 0:
        n = _integer("steps", steps, 1)
        return core.StepPlan(core.StepPlan.equal(n, end), max_cuts, easy)
    try:
        given = np.asarray(steps, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"steps is {steps!r}: give a number of steps or a list of t") from None
    if given.ndim != 1 or len(given) == 0:
        raise ValueError(f"steps has shape {given.shape}: give a number of steps or a list of t")
    if not np.all((given > 0) & (given <= end)):
        bad = given[~((given > 0) & (given <= end))][0]
        hint = "" if t_end is not None else ", or give t_end"
        raise ValueError(
            f"steps holds t = {bad:g}: each t must be above 0 and at most {end:g}{hint}"
        )
    if np.any(np.diff(given) <= 0):
        k = int(np.argmax(np.diff(given) <= 0))
        raise ValueError(
            f"steps holds {given[k + 1]:g} after {given[k]:g}: each t must be larger than the last"
        )
    return core.StepPlan(given.tolist(), max_cuts, easy)


def _integer(name: str, value: Any, least: int, most: int | None = None) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}: give an integer") from None
    if number < least or (most is not None and number > most):
        limit = f"at least {least}" if most is None else f"from {least} to {most}"
        raise ValueError(f"{name} is {number}: give an integer {limit}")
    return number
