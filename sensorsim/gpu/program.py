"""Programs from shader files: every error names a file, every block and sampler is accounted for."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

import moderngl

from sensorsim.errors import GraphicsError
from sensorsim.gpu.shader_source import ShaderSource, expand_source
from sensorsim.gpu.uniform_block import UniformBlock

# sampler2D, isampler2D, usampler2D: the only plain uniforms that shaders may hold
_SAMPLER_TYPES = (0x8B5E, 0x8DCA, 0x8DD2)


def build_program(
    ctx: moderngl.Context,
    *,
    vertex: str,
    fragment: str,
    defines: Mapping[str, int] | None = None,
    generated: Mapping[str, str] | None = None,
    blocks: Sequence[UniformBlock] = (),
    samplers: Collection[str] = (),
    root: Path | None = None,
) -> moderngl.Program:
    """Expand, compile and link two entry files, paths from the shaders folder.

    Each block's text is at `generated/<block.include_name>.glsl`, beside the texts of `generated`. `samplers` names the
    textures that the program may read; `bind_samplers` gives them their units. Raises GraphicsError for text that does
    not expand, compile or link, for a define that neither file mentions, and as `link_program` does.
    """
    texts = {**(generated or {}), **{block.include_name: block.glsl() for block in blocks}}
    stages = [expand_source(path, defines=defines, generated=texts, root=root) for path in (vertex, fragment)]
    unused = set(defines or {}) - stages[0].defines_used - stages[1].defines_used
    if unused:
        raise GraphicsError(f"{vertex}, {fragment}: no line mentions the given defines {', '.join(sorted(unused))}")
    return link_program(ctx, stages[0], stages[1], blocks=blocks, samplers=samplers)


def link_program(
    ctx: moderngl.Context,
    vertex: ShaderSource,
    fragment: ShaderSource,
    *,
    blocks: Sequence[UniformBlock] = (),
    samplers: Collection[str] = (),
) -> moderngl.Program:
    """Compile and link two expanded stages, check what the program takes in, and set its block bindings.

    A block may be given that the program does not use. Raises GraphicsError for a block or sampler that was not given,
    a block whose GL size is not its Python size, and a plain uniform that is no 2-D sampler.
    """
    try:
        program = ctx.program(vertex_shader=vertex.text, fragment_shader=fragment.text)
    except moderngl.Error as error:
        raise GraphicsError(_translated(str(error), vertex, fragment)) from error
    name = f"{vertex.files[0]}, {fragment.files[0]}"
    try:
        _bind_blocks(name, program, {block.name: block for block in blocks})
        _check_uniforms(name, program, samplers)
    except GraphicsError:
        program.release()
        raise
    program.extra = {"name": name, "samplers": frozenset(samplers)}
    return program


def bind_samplers(program: moderngl.Program, units: Mapping[str, int]) -> None:
    """Give each sampler of a program from `build_program` its texture unit.

    A sampler that was declared but that the compiler found unused may be given or not. Raises GraphicsError for a name
    that was not declared, a sampler in use without a unit, a unit given twice or beyond the driver's number.
    """
    name, declared = program.extra["name"], program.extra["samplers"]
    active = {uniform.name: uniform for uniform in _uniforms(program)}
    unknown = sorted(units.keys() - declared)
    missing = sorted(active.keys() - units.keys())
    if unknown or missing:
        raise GraphicsError(f"{name}: samplers without a unit: {missing or 'none'}; not declared: {unknown or 'none'}")
    limit = program.ctx.info["GL_MAX_TEXTURE_IMAGE_UNITS"]
    if len(set(units.values())) < len(units) or not all(0 <= unit < limit for unit in units.values()):
        raise GraphicsError(f"{name}: texture units {dict(units)} are not distinct numbers below {limit}")
    for key in active:
        active[key].value = units[key]


def _uniforms(program: moderngl.Program) -> Iterator[moderngl.Uniform]:
    return (member for member in map(program.__getitem__, program) if isinstance(member, moderngl.Uniform))


def _bind_blocks(name: str, program: moderngl.Program, blocks: Mapping[str, UniformBlock]) -> None:
    for member in map(program.__getitem__, program):
        if not isinstance(member, moderngl.UniformBlock):
            continue
        block = blocks.get(member.name)
        if block is None:
            raise GraphicsError(f"{name}: uniform block {member.name} was not given to the program")
        if member.size != block.dtype.itemsize:
            raise GraphicsError(
                f"{name}: block {member.name} has {member.size} bytes in OpenGL, {block.dtype.itemsize} in Python"
            )
        member.binding = block.binding
    bindings = [block.binding for block in blocks.values()]
    if len(set(bindings)) < len(bindings):
        raise GraphicsError(f"{name}: blocks {', '.join(blocks)} share a binding: {bindings}")


def _check_uniforms(name: str, program: moderngl.Program, samplers: Collection[str]) -> None:
    for uniform in _uniforms(program):
        # gl_type is missing from moderngl's stubs
        if getattr(uniform, "gl_type", None) not in _SAMPLER_TYPES or uniform.array_length != 1:
            raise GraphicsError(f"{name}: uniform '{uniform.name}' is no single 2-D sampler; it belongs in a block")
        if uniform.name not in samplers:
            given = ", ".join(sorted(samplers)) or "none"
            raise GraphicsError(f"{name}: sampler '{uniform.name}' was not declared; declared are: {given}")


def _translated(log: str, vertex: ShaderSource, fragment: ShaderSource) -> str:
    """The driver's log on one line per message, headed by the stage's file or by both where linking failed."""
    stage = vertex if "vertex_shader" in log else fragment if "fragment_shader" in log else None
    lines = [line for line in log.split("=\n", 1)[-1].splitlines() if line.strip()]
    if stage is None:
        return "\n".join((f"{vertex.files[0]}, {fragment.files[0]}: does not link", *lines))
    return "\n".join((f"{stage.files[0]}: does not compile", *map(stage.translate, lines)))
