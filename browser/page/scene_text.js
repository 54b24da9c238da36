// The text of the scene, which is JSON with comments. Values are changed one at a time within the text, so that
// comments and the order of keys stay.

/** Thrown if a text is not valid JSON. */
class TextFault extends Error {}

const deepest = 64; // deepest nesting of lists and objects

/** Reads the words of a text one after the other. */
function makeScanner(text) {
  const scanner = { at: 0 };
  const match = (pattern) => {
    pattern.lastIndex = scanner.at;
    return pattern.exec(text)?.[0];
  };
  scanner.fault = (words) => { throw new TextFault(`${words} at character ${scanner.at + 1}`); };
  /** Skips blanks and comments. */
  scanner.skip = () => { scanner.at += match(/(?:\s+|\/\/[^\n]*|\/\*[\s\S]*?\*\/)*/y).length; };
  scanner.take = (character) => {
    scanner.skip();
    if (text[scanner.at] !== character) return false;
    ++scanner.at;
    return true;
  };
  scanner.leaf = () => {
    const word = match(/"(?:[^"\\]|\\.)*"|[-+\w.]+/y);
    if (!word) scanner.fault("a value is missing");
    try {
      const value = JSON.parse(word);
      scanner.at += word.length;
      return value;
    } catch {
      return scanner.fault(`"${word.slice(0, 20)}" is no JSON`);
    }
  };
  return scanner;
}

/** Reads JSON with comments. Returns nodes {kind, from, to, value | items | members}; from and to are positions in the
 * text. */
function parseText(text) {
  const scanner = makeScanner(text);
  function list(close, one) {
    while (!scanner.take(close)) {
      scanner.skip();
      one();
      scanner.skip();
      if (!scanner.take(",") && text[scanner.at] !== close) scanner.fault(`"${close}" or "," is missing`);
    }
  }
  function member(depth) {
    const key = scanner.leaf();
    if (!scanner.take(":")) scanner.fault("\":\" is missing");
    return { key, value: node(depth) };
  }
  function node(depth) {
    if (depth > deepest) scanner.fault("the nesting is too deep");
    scanner.skip();
    const from = scanner.at;
    const [items, members] = [[], []];
    if (scanner.take("{")) {
      list("}", () => members.push(member(depth + 1)));
      return { kind: "object", from, to: scanner.at, members };
    }
    if (scanner.take("[")) {
      list("]", () => items.push(node(depth + 1)));
      return { kind: "array", from, to: scanner.at, items };
    }
    return { kind: "leaf", value: scanner.leaf(), from, to: scanner.at };
  }
  const root = node(0);
  scanner.skip();
  if (scanner.at < text.length) scanner.fault("there is more behind the scene");
  return root;
}

/** The node at a path such as ["ships", 0, "position_m"]; undefined if there is none. */
function nodeAt(root, path) {
  return path.reduce((node, step) => (typeof step === "number" ? node?.items?.[step]
    : node?.members?.find(({ key }) => key === step)?.value), root);
}

/** The value of a node. */
function valueOf(node) {
  if (node.kind === "array") return node.items.map(valueOf);
  if (node.kind === "object") return Object.fromEntries(node.members.map(({ key, value }) => [key, valueOf(value)]));
  return node.value;
}

const readValue = (text, path) => {
  const node = nodeAt(parseText(text), path);
  return node && valueOf(node);
};

const written = (value) => JSON.stringify(value).replaceAll(/,(?=\S)/g, ", ").replaceAll(/":(?=\S)/g, "\": ");

/** Returns the text with a changed value at a path. Missing objects are created. An index one past the end of a list
 * appends an item. */
function withValue(text, path, value) {
  const root = parseText(text);
  const there = nodeAt(root, path);
  const splice = (from, to, words) => text.slice(0, from) + words + text.slice(to);
  if (there) return splice(there.from, there.to, written(value));
  const known = path.findLastIndex((_, k) => nodeAt(root, path.slice(0, k)));
  const parent = nodeAt(root, path.slice(0, known));
  const made = path.slice(known + 1).reduceRight((inner, step) =>
    (typeof step === "number" ? [inner] : { [step]: inner }), value);
  const isList = parent.kind === "array";
  const last = (isList ? parent.items.at(-1) : parent.members?.at(-1)?.value)?.to;
  const words = isList ? written(made) : `${JSON.stringify(path[known])}: ${written(made)}`;
  if (parent.kind === "leaf") return text;
  if (last === undefined) return splice(parent.from + 1, parent.from + 1, words);
  const indent = isList ? "\n    " : "\n".padEnd(2 * known + 3, " ");
  return splice(last, last, `,${indent}${words}`);
}

/** Returns the text without an item of a list. */
function withoutItem(text, path) {
  const list = nodeAt(parseText(text), path.slice(0, -1));
  const index = path.at(-1);
  const item = list.items[index];
  const next = list.items[index + 1];
  const before = list.items[index - 1];
  if (next) return text.slice(0, item.from) + text.slice(next.from);
  return text.slice(0, before ? before.to : item.from) + text.slice(item.to);
}
