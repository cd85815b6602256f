"""Pages of the view in the machine's own chromium, which draws without a graphics card."""

import shutil

import pytest
from trocar_scenes import stepped, tissue

import tissu as ts

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
WAIT = 120_000
"""Longest wait for the page [ms]: a busy machine draws slowly."""
SOFTWARE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]


@pytest.fixture(scope="session")
def browser():
    """The browser, started once; skipped where the machine has none."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="no playwright: pip install it")
    if CHROMIUM is None:
        pytest.skip("no chromium on this machine (Debian: apt install chromium)")
    with sync_api.sync_playwright() as driver:
        found = driver.chromium.launch(executable_path=CHROMIUM, args=[*SOFTWARE, "--no-sandbox"])
        yield found
        found.close()


@pytest.fixture
def surroundings():
    """Of tests whose pages are lit as a user's are."""


@pytest.fixture(autouse=True)
def _lamps_alone(request, monkeypatch):
    """Pages without `surroundings` are lit by lamps.

    What is around a scene and shines on it takes seconds of both cores to prepare where no graphics
    card does it, for each page, and doubles the work of each picture.
    """
    if "surroundings" in request.fixturenames:
        return
    viser = pytest.importorskip("viser", reason="no viser: pip install 'tissu[view]'")
    make = viser.ViserServer

    def server(*given, **more):
        made = make(*given, **more)
        made.scene.configure_environment_map(None)
        return made

    monkeypatch.setattr(viser, "ViserServer", server)


@pytest.fixture
def views():
    """Opens views without a window of the desk's own browser, and closes them."""
    opened = []

    def make(simulation, **options):
        opened.append(ts.view(simulation, **{"browser": False, **options}))
        return opened[-1]

    yield make
    for view in opened:
        view.close()


@pytest.fixture
def visits(browser):
    """Opens empty pages, each of a visitor of its own, and closes them.

    All of them, of failed tests too: a page that plays on takes the processor from all later ones.
    """
    visitors = []

    def make(**options):
        visitors.append(browser.new_context(viewport={"width": 800, "height": 500}, **options))
        page = visitors[-1].new_page()
        page.set_default_timeout(WAIT)
        return page

    yield make
    for visitor in visitors:
        visitor.close()


@pytest.fixture
def pages(visits):
    """Opens pages of views."""

    def make(url):
        page = visits()
        page.goto(url)
        page.get_by_text("real time").or_(page.get_by_text("paused")).first.wait_for()
        return page

    return make


@pytest.fixture
def live():
    """Makes the trocars of a scene, steps them, and switches them off."""
    from tissu.live_view.trocars.trocars import LiveTrocars

    opened = []

    def make(scene=None, *, steps=0, **options):
        simulation = (tissue() if scene is None else scene).compile()
        opened.append(LiveTrocars([simulation], **options))
        stepped(opened[-1], steps)
        return opened[-1]

    yield make
    for one in opened:
        one.close()
