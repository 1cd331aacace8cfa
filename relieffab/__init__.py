"""From a 3D model to a carved sunken relief.

The way through: `read_mesh` (or `make_mesh`), `make_layers`, `make_relief`,
`make_panel`, `plan`, `write_program`, `verify`, `send`.  Names are loaded when
they are first used.
"""

import lazy_loader

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules=["profiles"],
    submod_attrs={
        "cutter": ["Cutter"],
        "errors": ["FindingsError", "InputError", "MachineError", "RelieffabError"],
        "fittings": ["Edge", "Frame", "Hole", "Keyhole"],
        "gcode.ease": ["eased"],
        "gcode.estimate": ["Pace", "estimate", "pace"],
        "gcode.read": ["read_program"],
        "gcode.setup": ["Setup"],
        "gcode.slab": ["Slab"],
        "gcode.verify": ["Verification", "verify"],
        "gcode.write": ["write_program"],
        "grbl.port": ["open_port"],
        "grbl.sender": ["send"],
        "grid": ["Grid"],
        "layers.art.make": ["layers_of_art", "placed_on"],
        "layers.art.svg": ["read_svg"],
        "layers.art.text": ["set_text"],
        "layers.image.make": ["Showing", "layers_of_picture"],
        "layers.image.read": ["read_picture"],
        "layers.lines.drawing": ["Drawing"],
        "layers.lines.image": ["line_image"],
        "layers.lines.svg": ["strokes_from_svg", "strokes_to_svg"],
        "layers.make": ["make_layers"],
        "layers.mesh": ["Mesh", "make_mesh", "read_mesh"],
        "layers.model": ["Layers", "Stroke"],
        "layers.view": ["View", "guess_up", "named_view"],
        "machine": ["Machine", "Material"],
        "panel.carve": ["make_panel"],
        "panel.draft": ["Draft", "check_draft"],
        "panel.export": ["write_3mf", "write_panel", "write_stl"],
        "panel.model": ["Panel"],
        "panel.mould": ["make_mould"],
        "panel.plaque": ["make_plaque"],
        "panel.rounds": ["make_round"],
        "panel.tiles": ["Tile", "split"],
        "picture": ["panel_picture", "standing_picture"],
        "relief.compose": ["Placed", "compose"],
        "relief.model": ["Relief"],
        "relief.make": ["make_relief"],
        "relief.png": ["to_png"],
        "relief.store": ["read_relief", "to_tiff"],
        "relief.style.make": ["carve_marks"],
        "relief.style.model": ["Marks", "Style"],
        "relief.targets": ["Carving"],
        "round": ["Curved", "Round"],
        "stock": ["Stock"],
        "subject": ["cat", "falcon", "lotus", "scarab"],
        "template.model": ["Template", "make_template"],
        "template.pdf": ["to_pdf"],
        "template.svg": ["to_svg"],
        "toolpath.path": ["Toolpath"],
        "toolpath.plan": ["plan"],
        "toolpath.positions": ["Position", "positions"],
    },
)
