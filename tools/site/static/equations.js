// Renders the equations of a page by KaTeX, which the site has in _static/katex. Without scripts their TeX is left.
const HERE = document.currentScript.src;

function render() {
  for (const element of document.querySelectorAll(".tex"))
    window.katex.render(element.textContent, element,
      { displayMode: element.classList.contains("display"), throwOnError: false });
}

document.addEventListener("DOMContentLoaded", () => {
  if (!document.querySelector(".tex")) return;
  const style = document.createElement("link");
  style.rel = "stylesheet";
  style.href = new URL("katex/katex.min.css", HERE);
  const script = document.createElement("script");
  script.src = new URL("katex/katex.min.js", HERE);
  script.onload = render;
  document.head.append(style, script);
});
