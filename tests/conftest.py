"""One OpenGL context for the whole run, which each test must leave without an error; a table cache of the run's own."""

import os
from collections.abc import Iterator

import moderngl
import pytest

from sensorsim.gpu import create_context
from sensorsim.tables import CACHE_VARIABLE


@pytest.fixture(scope="session", autouse=True)
def _own_table_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Tests that render share what they bake, in all processes; the user's cache is neither read nor added to."""
    before = os.environ.get(CACHE_VARIABLE)
    own = tmp_path_factory.getbasetemp()
    shared = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
    os.environ[CACHE_VARIABLE] = str(shared / "tables")
    yield
    os.environ.pop(CACHE_VARIABLE)
    if before is not None:
        os.environ[CACHE_VARIABLE] = before


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
