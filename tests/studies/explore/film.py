"""The moving picture of the README: film.py PROGRAM BROWSER studies/examples/explore.gif. Frames are pictures of the page
while sliders move, joined by Pillow, which matplotlib brings."""

import os
import sys
import tempfile

from PIL import Image

from explore_page import Browser, moved, started

PROGRAM, BROWSER, TARGET = sys.argv[1:4]
WIDTH, HEIGHT, SCALE = 1320, 770, 0.62


def main():
    target = os.path.abspath(TARGET)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        process, address = started("--db", "results.db")
        browser = Browser(BROWSER, WIDTH, HEIGHT)
        frames = 0
        try:
            browser.size(WIDTH, HEIGHT, scale=SCALE)
            browser.call("Emulation.setScrollbarsHidden", hidden=True)
            browser.open(address)
            browser.until("document.documentElement.dataset.ready")
            browser.value("document.querySelector('#welcome').remove()")
            browser.value("for (const one of document.querySelectorAll('#inputs fieldset')) "
                          "if (!/^(Layer|Motion and load)/.test(one.textContent)) one.hidden = true")
            browser.click("#pin")
            for key, places in (("load", range(0, 7)), ("layer_thickness", range(0, 6))):
                for place in places:
                    moved(browser, key, 0.5 + 0.015 * place)
                    browser.value("scrollTo(0, 0)")
                    browser.picture(f"frame{frames}.png", whole=False)
                    frames += 1
        finally:
            browser.end()
            process.kill()
        pictures = [Image.open(f"frame{n}.png").convert("RGB") for n in range(frames)]
        # One palette for all, so that only what moves differs from frame to frame.
        palette = pictures[frames // 2].quantize(128)
        first, *others = [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in pictures]
        first.save(target, save_all=True, append_images=others, duration=250, loop=0, optimize=True)


main()
