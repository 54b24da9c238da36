// The contrast of texts in a page, by WCAG 2.1 (1.4.3): from the computed colours of all texts that are shown, on the
// backgrounds that lie under them.
"use strict";

/** In a page: each text that is shown, with its contrast to its background. Controls that are disabled are exempt; text
 * that is drawn into a canvas has no computed style and is not seen here. */
function textContrasts() {
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
  return [...document.body.querySelectorAll("*")].filter((element) => hasText(element) && isShown(element))
    .map((element) => {
      const under = backgroundOf(element);
      const shades = [luminance(under), luminance(painted(getComputedStyle(element).color, under, opacityOf(element)))];
      const words = element.matches("input, textarea") ? element.value : element.textContent;
      return { contrast: (Math.max(...shades) + 0.05) / (Math.min(...shades) + 0.05),
        words: `${element.tagName.toLowerCase()}#${element.id}.${element.className} "${words.trim().slice(0, 30)}"` };
    });
}

const least = 4.5;

/** The texts of a page, or of a frame in it, whose contrast is too small, in words; `seen` counts all texts. */
exports.faintTexts = async (page) => {
  const texts = await page.evaluate(textContrasts);
  return { seen: texts.length, faint: [...new Set(texts.filter(({ contrast }) => contrast < least)
    .map(({ contrast, words }) => `${words}: ${contrast.toFixed(2)}`))] };
};
