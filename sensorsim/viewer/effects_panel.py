"""The window of effects: which are on, what leaving each out would change at most, and switches. Needs `viewer`."""

from dataclasses import replace

from imgui_bundle import imgui

from sensorsim.effects import NOT_MODELLED, Ledger
from sensorsim.effects.choice import BASES
from sensorsim.viewer.effect_list import WORDS, EffectLine, effect_lines, with_word
from sensorsim.viewer.state import ViewState

WIDTH, HEIGHT = 560.0, 540.0  # [pixels]


def effects_panel(state: ViewState, ledger: Ledger, left: float, top: float) -> ViewState:
    """The window, at a place where it was never moved; the next state."""
    imgui.set_next_window_pos(imgui.ImVec2(left + 10.0, top + 60.0), imgui.Cond_.first_use_ever)
    imgui.set_next_window_size(imgui.ImVec2(WIDTH, HEIGHT), imgui.Cond_.first_use_ever)
    imgui.set_next_window_bg_alpha(0.93)
    _, shown = imgui.begin("Effects (U closes this)", True, imgui.WindowFlags_.no_scrollbar)
    state = replace(state, effects=bool(shown))
    place = state.place
    imgui.set_next_item_width(90.0)
    changed, index = imgui.combo("of all: by their bounds, on, or off", BASES.index(place.choice.base), list(BASES))
    choice = replace(place.choice, base=BASES[index]) if changed else place.choice
    columns = imgui.TableFlags_.scroll_y | imgui.TableFlags_.row_bg
    if imgui.begin_table("effects", 4, columns, imgui.ImVec2(0.0, -28.0)):
        for width in (180.0, 110.0, 50.0, 150.0):
            imgui.table_setup_column("", imgui.TableColumnFlags_.width_fixed, width)
        for line in effect_lines(ledger, choice):
            word = _line(line)
            choice = with_word(choice, line.name, word) if word != line.word else choice
        imgui.end_table()
    imgui.text_disabled("Not modelled at all: point here")
    if imgui.is_item_hovered():
        imgui.set_tooltip("\n".join(NOT_MODELLED))
    imgui.end()
    return replace(state, place=replace(place, choice=choice))


def _line(line: EffectLine) -> str:
    """One line of the table; the word that is asked for from now on."""
    imgui.table_next_row()
    imgui.table_next_column()
    imgui.align_text_to_frame_padding()
    imgui.text(line.name.replace("_", " "))
    if imgui.is_item_hovered():
        imgui.set_tooltip(line.hint)
    imgui.table_next_column()
    imgui.set_next_item_width(90.0)
    changed, index = imgui.combo(f"##{line.name}", WORDS.index(line.word), list(WORDS))
    imgui.table_next_column()
    if line.on:
        imgui.text_colored(imgui.ImVec4(0.55, 1.0, 0.6, 1.0), "on")
    else:
        imgui.text_disabled("off")
    imgui.table_next_column()
    imgui.text(line.bound)
    return WORDS[index] if changed else line.word
