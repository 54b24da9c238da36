// Order of the results of Sphinx's search: first guides, then reference and theory, then pages for developers.
"use strict";

/** What a page's part of the site adds to the score of a hit in it; a hit in a title has 15, in a text 5. */
const partOrder = [
  [/^(start|tutorial|gallery|cite|glossary|index)$/, 12],
  [new RegExp("^(view|figures|loads|movie|channel|brash|inspect|why-it-split|export|ships|management|import|cut|couple|"
    + "database|studies|python|environment)$"), 12],
  [/^(scene|run-folder|reference\/commands.*)$/, 8],
  [/^theory\//, 4],
  [/^(decisions\/|changelog|contributing|architecture)/, -20],
  [/^reference\/cpp/, -12],
];

var Scorer = {
  score: ([page, , , , score]) => score + (partOrder.find(([pattern]) => pattern.test(page))?.[1] ?? 0),
  objNameMatch: 11, objPartialMatch: 6, objPrio: { 0: 15, 1: 5, 2: -5 }, objPrioDefault: 0, title: 15, partialTitle: 7,
  term: 5, partialTerm: 2,
};
