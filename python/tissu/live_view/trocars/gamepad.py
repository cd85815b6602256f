"""A gamepad of the browser: a script on the page writes its sticks into a field of the panel.

viser carries no gamepads. A frame in the panel, which is of the same origin as the page, reads them
by the Gamepad API (W3C) and writes into a text field as a hand at the keyboard would, so that its
words come by the page's own way, with the rights of the page.
"""

from __future__ import annotations

from html import escape

import numpy as np
from numpy.typing import NDArray

from tissu.errors import ParameterError

EVERY = 50
"""ms from one word of the script to the next while a stick is deflected."""
_SCRIPT = """<script>
const word = %(word)s, place = %(place)d, page = window.parent;
const put = Object.getOwnPropertyDescriptor(page.HTMLInputElement.prototype, 'value').set;
let count = 0, still = true;
setInterval(() => {
  const pads = [...page.navigator.getGamepads()].filter(pad => pad && pad.connected);
  const pad = pads[place], sticks = pad ? [0, 1, 3, 2].map(k => pad.axes[k] || 0) : [0, 0, 0, 0];
  const rests = sticks.every(value => Math.abs(value) < 0.05);
  if (rests && still) return;
  still = rests;
  const field = [...page.document.querySelectorAll('input')].find(i => i.value.startsWith(word));
  if (!field) return;
  const said = rests ? [0, 0, 0, 0] : sticks;
  count += 1;
  put.call(field, word + ' ' + said.map(value => value.toFixed(2)).join(' ') + ' #' + count);
  field.dispatchEvent(new page.Event('input', {bubbles: true}));
}, %(every)d);
</script>"""


def word_of(place: int) -> str:
    """What the field of a trocar's gamepad begins with."""
    return f"gamepad {place + 1}:"


def reader(place: int) -> str:
    """HTML of the frame that reads a gamepad; `place`: of those that are connected, from 0 on."""
    script = _SCRIPT % {"word": f"'{word_of(place)}'", "place": place, "every": EVERY}
    style = "display:block;width:0;height:0;border:0"
    return f'<iframe title="reads a gamepad" style="{style}" srcdoc="{escape(script)}"></iframe>'


def sticks_of(text: str) -> NDArray[np.float64]:
    """The four axes (4,) that a field says, from -1 to 1: e_X, e_Y, depth and own rotation.

    Sticks point down where they are positive (W3C): the left one is e_X and e_Y of the port, and
    forward with the right one is deeper.

    Raises:
        ParameterError: it says none.
    """
    words = text.partition(":")[2].partition("#")[0].split()
    try:
        found = np.array([float(one) for one in words])
    except ValueError:
        found = np.empty(0)
    if found.shape != (4,) or not np.isfinite(found).all() or np.abs(found).max() > 1.01:
        raise ParameterError(
            f"found {text[:60]!r} of a gamepad; four numbers from -1 to 1 are accepted, such as "
            f"'{word_of(0)} 0 0.5 0 0'"
        )
    return np.array([found[0], -found[1], -found[2], found[3]])
