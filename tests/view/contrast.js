// The contrast of texts in a page, by WCAG 2.1 (1.4.3): from the computed colours of all texts that are shown, on the
// backgrounds that lie under them; and from the colours with which texts are drawn into canvases, on their outlines or
// on the background of the canvas.
"use strict";

/** In a page: sets `textContrasts`. of() returns each text that is shown, with its contrast to its background; controls
 * that are disabled are exempt. watch() records the texts that are drawn into canvases from then on, and drawn()
 * returns them with their contrasts: to the outline if the same words were outlined before, else to the canvas's
 * background. */
function watchTexts() {
  const paint = Object.assign(document.createElement("canvas"), { width: 1, height: 1 })
    .getContext("2d", { willReadFrequently: true });
  const isTransparent = (css) => /^rgba\(.*, 0\)$|^transparent$/.test(css);
  /** The colour that a CSS colour gives on another colour [r, g, b]. */
  const painted = (css, under, opacity = 1) => {
    paint.globalAlpha = 1;
    paint.fillStyle = `rgb(${under.join()})`;
    paint.fillRect(0, 0, 1, 1);
    paint.globalAlpha = opacity;
    paint.fillStyle = css;
    paint.fillRect(0, 0, 1, 1);
    return [...paint.getImageData(0, 0, 1, 1).data.slice(0, 3)];
  };
  const luminance = (colour) => {
    const [r, g, b] = colour.map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const opacityOf = (element) => (element ? Number(getComputedStyle(element).opacity) * opacityOf(element.parentElement)
    : 1);
  const backgroundOf = (element) => {
    if (!element) return painted("Canvas", [255, 255, 255]);
    const css = getComputedStyle(element).backgroundColor;
    return isTransparent(css) ? backgroundOf(element.parentElement)
      : painted(css, backgroundOf(element.parentElement), opacityOf(element));
  };
  const hasText = (element) => element.matches("input:not([type=checkbox], [type=range], [type=file]), textarea")
    || [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim());
  const isShown = (element) => element.checkVisibility({ opacityProperty: true, visibilityProperty: true })
    && element.getBoundingClientRect().width > 1 && !element.closest("script, style, noscript, svg, option")
    && !element.closest(":disabled");
  const contrast = (ink, under) => {
    const shades = [luminance(under), luminance(ink)];
    return (Math.max(...shades) + 0.05) / (Math.min(...shades) + 0.05);
  };
  const of = () => [...document.body.querySelectorAll("*")].filter((element) => hasText(element) && isShown(element))
    .map((element) => {
      const under = backgroundOf(element);
      const words = element.matches("input, textarea") ? element.value : element.textContent;
      return { contrast: contrast(painted(getComputedStyle(element).color, under, opacityOf(element)), under),
        words: `${element.tagName.toLowerCase()}#${element.id}.${element.className} "${words.trim().slice(0, 30)}"` };
    });
  const found = [];
  const watch = () => {
    const { fillText, strokeText } = CanvasRenderingContext2D.prototype;
    const outlines = new WeakMap(); // of a canvas, the last words that were outlined, and in which colour
    Object.assign(CanvasRenderingContext2D.prototype, {
      strokeText(words, ...rest) {
        outlines.set(this.canvas, { words, colour: this.strokeStyle });
        return strokeText.call(this, words, ...rest);
      },
      fillText(words, ...rest) {
        const outline = outlines.get(this.canvas);
        const behind = backgroundOf(this.canvas);
        const under = outline?.words === words ? painted(outline.colour, behind) : behind;
        found.push({ contrast: contrast(painted(this.fillStyle, under, this.globalAlpha), under),
          words: `canvas "${words}" ${this.fillStyle}` });
        return fillText.call(this, words, ...rest);
      },
    });
  };
  window.textContrasts = { of, watch, drawn: () => found };
}

const least = 4.5;

const faintOf = (texts) => ({ seen: texts.length, faint: [...new Set(texts.filter(({ contrast }) => contrast < least)
  .map(({ contrast, words }) => `${words}: ${contrast.toFixed(2)}`))] });

/** The texts of a page, or of a frame in it, whose contrast is too small, in words; `seen` counts all texts. */
exports.faintTexts = async (page) => {
  await page.evaluate(watchTexts);
  return faintOf(await page.evaluate(() => window.textContrasts.of()));
};

/** The same of the texts that `act` makes the page draw into canvases. */
exports.faintTextsInCanvases = async (page, act) => {
  await page.evaluate(watchTexts);
  await page.evaluate(() => window.textContrasts.watch());
  await act();
  return faintOf(await page.evaluate(() => window.textContrasts.drawn()));
};
