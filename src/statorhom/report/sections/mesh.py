"""The finite-element mesh and what its finiteness does to the frequencies."""

from __future__ import annotations

from collections.abc import Sequence

from statorhom.mesh.mirror_mesh import MirrorMesh
from statorhom.report.context import Step, are_blocks, coupon_of
from statorhom.report.document import (
    Block,
    Column,
    Paragraph,
    Picture,
    Row,
    Section,
    Table,
    joined,
    strong,
    text,
)
from statorhom.report.figures.block_picture import DrawnBlock
from statorhom.report.figures.convergence_plot import WIDTH_MM as PLOT_WIDTH_MM
from statorhom.report.figures.convergence_plot import convergence_plot
from statorhom.report.figures.mesh_picture import WIDTH_MM, mesh_picture
from statorhom.report.wording import WING, constant_symbol, constant_value, frequency, mode_name
from statorhom.results import Convergence, FitSummary, StageResult

_LEAST_SHOWN_PERCENT = 1e-3


def mesh(steps: Sequence[Step]) -> Section:
    """Pictures of the meshes, and the convergence of the modes."""
    lead = text(
        f"The model is made of bricks with 20 nodes. {_part(steps)} A finite mesh is always a little too stiff: "
        "where tables follow, modes were computed on several meshes and extrapolated to an infinitely fine "
        "one. What remains uncertain counts as an uncertainty of the model and is not fitted into the "
        "materials.",
    )
    blocks: list[Block] = [Paragraph(lead, "lead")]
    drawn: list[tuple[int, tuple[str, ...]]] = []
    for step in steps:
        blocks += _step(step, drawn)
    return Section("Mesh and its error", tuple(blocks))


def _part(steps: Sequence[Step]) -> str:
    """What is meshed."""
    if coupon_of(steps) == WING:
        return (
            "The right half of the wing is meshed; its modes are symmetric or antisymmetric about the middle."
        )
    if are_blocks(steps):
        return "An eighth of the body is meshed; the modes are sorted by their symmetry about its three middle planes."
    what = "of a slot pitch" if coupon_of(steps) is None else "of a sector"
    of = "machine" if coupon_of(steps) is None else "tube"
    return f"One half {what} is meshed and copied around, so that the model has exactly the symmetry of the {of}."


def _step(step: Step, drawn: list[tuple[int, tuple[str, ...]]]) -> list[Block]:
    blocks: list[Block] = []
    if step.shapes is not None:
        mesh = step.shapes.file.mesh
        look = (len(mesh.elements), mesh.regions)
        # steps that only change a material share their mesh: one picture is enough
        if look not in drawn:
            drawn.append(look)
            blocks.append(_picture(step))
    if step.result.convergence:
        blocks += _convergence(step.result)
    if not blocks:
        return []
    return [Paragraph(text(f"Step {step.result.name}"), "heading"), *blocks]


def _picture(step: Step) -> Picture:
    assert step.shapes is not None
    mesh, body = step.shapes.file.mesh, step.shapes.body
    size = f"{mesh.copies * len(mesh.elements)} bricks, {mesh.full_dof} degrees of freedom."
    note = "This is the mesh of the pictures; the table lists those of the fit."
    if isinstance(mesh, MirrorMesh) or isinstance(body, DrawnBlock):
        assert isinstance(body, DrawnBlock)
        return Picture(body.mesh_picture(), "png", WIDTH_MM, "mesh", text(f"The whole body: {size} {note}"))
    part = "sector" if step.coupon else "slot pitch"
    whole = f"tube (right): {size}" if step.coupon else f"stator (right): {mesh.slots} slots, {size}"
    caption = text(f"One {part} (left) and the whole {whole} {note}")
    content = mesh_picture(mesh, body.surface)
    return Picture(content, "png", WIDTH_MM, "mesh of one slot pitch and of the whole stator", caption)


def _convergence(stage: StageResult) -> list[Block]:
    blocks: list[Block] = [_table(stage.convergence)]
    caption = text(
        "How far each mesh lies above the extrapolated frequency, a colour per "
        + ("kind of motion." if any(c.kind for c in stage.convergence) else "order r; dashed where n is odd.")
    )
    alt = "convergence of the frequencies with the mesh"
    drawable = [c for c in stage.convergence if len(c.dof) > 1]
    if drawable:
        blocks.append(Picture(convergence_plot(drawable), "svg", PLOT_WIDTH_MM, alt, caption))
    if stage.fit is not None:
        blocks += _cost(stage, stage.fit) + _reduction(stage.fit)
    return blocks


def _cost(stage: StageResult, fit: FitSummary) -> list[Block]:
    """What the constants would be if the fitting mesh were taken for the truth."""
    shown = [
        text(
            name, " ", constant_symbol(key), f" = {constant_value(key, alone, digits)} instead of ",
            strong(constant_value(key, c.value, digits)),
        )
        for name, region in stage.regions.items()
        for key, c in region.engineering.items()
        if c.status != "fixed" and (alone := fit.without_mesh_correction.get(f"{name}.{key}")) is not None
        for digits in [c.ci90 if c.status == "identified" else None]
    ]  # fmt: skip
    if not shown:
        return []
    return [
        Paragraph(
            text(
                "What the mesh costs: without the extrapolation, on the mesh of the fit alone, the same modes "
                "would have given ",
                joined(shown),
                ".",
            )
        )
    ]


def _reduction(fit: FitSummary) -> list[Block]:
    if fit.reduced_basis_deviation_percent is None:
        return []
    deviation = max(fit.reduced_basis_deviation_percent, _LEAST_SHOWN_PERCENT)
    note = (
        "During the search a reduced model stood in for the mesh. At the result, solved again without it, it "
        f"changed no frequency by more than {deviation:.2g} %"
    )
    if fit.reduced_basis_certified_percent is not None:
        certified = max(fit.reduced_basis_certified_percent, _LEAST_SHOWN_PERCENT)
        note += f"; its own certificate there is {certified:.2g} %"
    note += "."
    return [Paragraph(text(note), "note")]


def _table(series: Sequence[Convergence]) -> Table:
    dof = sorted({n for c in series for n in c.dof})
    columns = (
        Column(text("Mode")),
        *(Column(text(f"{n:,} DOF".replace(",", " ")), "right") for n in dof),
        Column(text("Extrapolated"), "right"),
        Column(text("Uncertainty"), "right"),
    )
    rows = tuple(
        Row(
            (
                text(strong(mode_name(c.order, c.axial, c.kind))),
                *(text(frequency(dict(zip(c.dof, c.frequency_hz, strict=True)).get(n))) for n in dof),
                text(strong(frequency(c.extrapolated_hz))),
                text(f"± {c.sd_percent:.2f} %"),
            )
        )
        for c in sorted(series, key=_by_name)
    )
    caption = (
        "Frequencies in Hz; DOF: degrees of freedom of the whole model; uncertainty: one standard deviation."
    )
    if any(len(c.dof) < len(dof) for c in series):
        caption += " Orders that were only predicted were not computed on every mesh."
    return Table(columns, rows, text(caption))


def _by_name(mode: Convergence) -> tuple[int, int, float]:
    unnamed = -1
    return (
        unnamed if mode.order is None else mode.order,
        unnamed if mode.axial is None else mode.axial,
        mode.extrapolated_hz,
    )
