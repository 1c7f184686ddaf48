"""The last stage of a frame on the graphics card: detail, window and grey, as display codes."""

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.gpu import RenderTarget, float_table, render_target, update_table
from sensorsim.render.blocks import DISPLAY
from sensorsim.render.passes import TEXTURE_UNITS, Pass, display_pass, screen_pass
from sensorsim.sensor import DETAIL_REACH, EDGE, TONE_ENTRIES, DisplaySettings, window_limits
from sensorsim.tables import LookupTable

MEANS = ("means_picture",)
PICTURE = ("radiance_picture",)


class DisplayStage:
    """Display codes of pictures of one size; passes that only some settings call for are built when they are."""

    def __init__(self, ctx: moderngl.Context, size: tuple[int, int]) -> None:
        self.ctx, self.size = ctx, size
        self.block = ctx.buffer(reserve=DISPLAY.dtype.itemsize)
        self.screen = render_target(ctx, size, {"grey": "R8"})
        curve = LookupTable(
            name="tone", quantity="Ratio", argument="Ratio", minimum=0.0, maximum=1.0, values=np.zeros(TONE_ENTRIES)
        )
        self.tone = float_table(ctx, "tone_table", curve.texels)
        self.straight, self.bent = display_pass(ctx), display_pass(ctx, curve)
        self.detail: list[tuple[Pass, RenderTarget]] = []

    def show(
        self, picture: moderngl.Texture, settings: DisplaySettings, curve: NDArray[np.float64] | None
    ) -> NDArray[np.uint8]:
        """Codes (height, width) of a picture of band radiance through a fixed window, by a curve if there is one."""
        low, high = window_limits(settings)
        self.block.write(
            DISPLAY.pack(
                level=0.5 * (low + high), span=high - low, black_hot=float(settings.polarity == "black-hot"),
                detail=settings.detail,
            )
        )  # fmt: skip
        self.block.bind_to_uniform_block(DISPLAY.binding)
        self.ctx.enable_only(moderngl.NOTHING)
        picture.use(TEXTURE_UNITS["radiance_picture"])
        if settings.detail != 1.0:
            self._enhance().use(TEXTURE_UNITS["radiance_picture"])
        if curve is not None:
            update_table(self.tone, curve[None, :])
            self.tone.use(TEXTURE_UNITS["tone_table"])
        self.screen.use()
        (self.straight if curve is None else self.bent).draw()
        return np.asarray(self.screen.read("grey")[:, :, 0])

    def _enhance(self) -> moderngl.Texture:
        """The picture with more of its detail."""
        if not self.detail:
            self.detail = _detail_passes(self.ctx, self.size)
        for one, target in self.detail:
            target.use()
            one.draw()
            target.texture("picture").use(TEXTURE_UNITS["means_picture"])
        return self.detail[-1][1].texture("picture")


def _detail_passes(ctx: moderngl.Context, size: tuple[int, int]) -> list[tuple[Pass, RenderTarget]]:
    """Means along rows and columns of the picture, then of what they say of its base, and the target of each."""
    made = []
    for base in (0, 1):
        defines = {"REACH": DETAIL_REACH, "BASE": base}
        rows = screen_pass(ctx, "sensor/detail_rows.frag", MEANS if base else PICTURE, defines, blocks=(DISPLAY,))
        columns = screen_pass(
            ctx, "sensor/detail_columns.frag", MEANS + PICTURE * base, defines, blocks=(DISPLAY,),
            generated={"edge": f"const float EDGE = {EDGE!r};\n"},
        )  # fmt: skip
        made.append((rows, render_target(ctx, size, {"picture": "RG32F"})))
        made.append((columns, render_target(ctx, size, {"picture": "R32F" if base else "RG32F"})))
    return made
