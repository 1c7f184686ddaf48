import json
import os
import subprocess
import sys
from pathlib import Path

import moderngl
import pytest

import sensorsim.gpu.context as context_module
import sensorsim.gpu.osmesa as osmesa_module
from sensorsim.errors import GraphicsError, InputError
from sensorsim.gpu import BACKENDS, context_info, create_context

# Draws a transcendental function of the pixel and prints driver and bytes, or why no context opened.
PROBE = """
import json, sys
from sensorsim.errors import GraphicsError
from sensorsim.gpu import context_info, create_context
try:
    ctx = create_context(sys.argv[1])
except GraphicsError as error:
    print(json.dumps({"error": str(error)}))
    raise SystemExit
vertex = "#version 330 core\\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }"
fragment = "#version 330 core\\nout vec4 o; void main() { vec2 p = gl_FragCoord.xy; o = vec4(exp(-p.x / 37.0), pow(p.y, 0.3), sin(p.x * p.y), 1.0 / p.x); }"
program = ctx.program(vertex_shader=vertex, fragment_shader=fragment)
target = ctx.framebuffer([ctx.texture((67, 41), 4, dtype="f4")])
target.use()
ctx.vertex_array(program, []).render(vertices=3)
info = context_info(ctx)
print(json.dumps({"backend": info["backend"], "renderer": info["renderer"], "version": info["version"],
                  "bytes": target.read(components=4, dtype="f4").hex(), "error": ctx.error}))
ctx.release()
"""  # noqa: E501


def probe(backend: str) -> dict[str, object]:
    package_parent = str(Path(context_module.__file__).parents[2])
    environment = {**os.environ, "PYTHONPATH": package_parent, "SENSORSIM_GL": "auto"}
    command = [sys.executable, "-c", PROBE, backend]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True, timeout=60)
    answer: dict[str, object] = json.loads(run.stdout)
    return answer


def test_egl_and_osmesa_give_the_same_bits() -> None:
    """Rationale: one rasteriser behind two doors. Expected: equal bytes, or OSMesa's library is not installed."""
    egl, osmesa = probe("egl"), probe("osmesa")
    assert (egl["backend"], egl["error"]) == ("egl", "GL_NO_ERROR")
    if "bytes" not in osmesa:
        assert "libOSMesa" in str(osmesa["error"])  # Mesa 25.1 and later do not ship it
        return
    assert (osmesa["backend"], osmesa["error"]) == ("osmesa", "GL_NO_ERROR")
    assert "Core Profile" in str(osmesa["version"])
    if osmesa["renderer"] == egl["renderer"]:  # EGL may be a hardware driver's
        assert osmesa["bytes"] == egl["bytes"]


def test_error_lists_every_attempt_and_the_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(**_: object) -> moderngl.Context:
        raise Exception("requested device index 0, but found 0 devices")

    monkeypatch.setattr(moderngl, "create_context", refuse)
    monkeypatch.setattr(osmesa_module, "LIBRARIES", ("libNoSuchMesa.so.8",))
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("SENSORSIM_GL", raising=False)
    with pytest.raises(GraphicsError) as caught:
        create_context()
    message = str(caught.value)
    assert "\n" not in message
    assert "egl: requested device index 0, but found 0 devices; osmesa: libNoSuchMesa.so.8" in message
    assert "x11: DISPLAY is not set" in message
    assert "apt-get install libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri" in message
    assert "libosmesa6" in message


def test_automatic_choice_goes_on_after_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    opened = object.__new__(moderngl.Context)
    asked: list[str] = []

    def fail(_: int | None) -> moderngl.Context:
        asked.append("egl")
        raise GraphicsError("no device")

    def succeed(_: int | None) -> moderngl.Context:
        asked.append("osmesa")
        return opened

    monkeypatch.setattr(context_module, "_CREATORS", {"egl": fail, "osmesa": succeed, "x11": fail})
    monkeypatch.delenv("SENSORSIM_GL", raising=False)
    assert create_context() is opened
    assert asked == ["egl", "osmesa"]
    assert opened.extra == {"backend": "osmesa"}


def test_environment_chooses_and_argument_wins(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def refusing(name: str) -> object:
        def refuse(_: int | None) -> moderngl.Context:
            asked.append(name)
            raise GraphicsError("refused")

        return refuse

    monkeypatch.setattr(context_module, "_CREATORS", {name: refusing(name) for name in BACKENDS})
    monkeypatch.setenv("SENSORSIM_GL", "x11")
    for backend in ("auto", "osmesa"):
        with pytest.raises(GraphicsError):
            create_context(backend)
    assert asked == ["x11", "osmesa"]


def test_unknown_names_are_refused_with_the_list(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match=r"'vulkan'.*auto, egl, osmesa, x11"):
        create_context("vulkan")
    monkeypatch.setenv("SENSORSIM_GL", "glx")
    with pytest.raises(InputError, match="environment: SENSORSIM_GL = 'glx'"):
        create_context()


def test_device_index_belongs_to_egl(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("SENSORSIM_GL", raising=False)
    with pytest.raises(InputError, match="device_index"):
        create_context("osmesa", device_index=0)
    with pytest.raises(GraphicsError, match="egl: requested device index 99") as caught:
        create_context(device_index=99)
    assert "osmesa:" not in str(caught.value)


def test_info_is_plain_and_complete(ctx: moderngl.Context) -> None:
    info = context_info(ctx)
    assert info["backend"] in BACKENDS
    assert json.loads(json.dumps(info))["limits"]["max_texture_size"] >= 1024
    assert float(info["glsl"]) >= 3.3
    assert context_info(ctx, "window")["backend"] == "window"
