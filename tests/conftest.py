"""One OpenGL context for the whole run; each test that uses it must leave it without an error."""

from collections.abc import Iterator

import moderngl
import pytest

from sensorsim.gpu import create_context


@pytest.fixture(scope="session")
def session_context() -> Iterator[moderngl.Context]:
    context = create_context()
    yield context
    context.release()


@pytest.fixture
def ctx(session_context: moderngl.Context) -> Iterator[moderngl.Context]:
    """The session's context, current, with a clean error flag before and after the test."""
    with session_context:
        assert session_context.error == "GL_NO_ERROR", "an error was left before this test"
        yield session_context
        assert session_context.error == "GL_NO_ERROR"
