// Exports from the page: the scene, the run as a folder in a .zip, and a link that contains the scene.

const crcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  return crc;
});

function crcOf(bytes) {
  let crc = ~0;
  for (let k = 0; k < bytes.length; ++k) crc = crcTable[(crc ^ bytes[k]) & 0xff] ^ (crc >>> 8);
  return ~crc >>> 0;
}

/** Passes bytes through one of the browser's compression streams. */
const throughStream = async (bytes, stream) =>
  new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

/** Makes a header of a .zip from numbers, each as [size in bytes, value]. */
function zipRecord(...numbers) {
  const record = new Uint8Array(numbers.reduce((sum, [size]) => sum + size, 0));
  const view = new DataView(record.buffer);
  let at = 0;
  for (const [size, value] of numbers) {
    if (size === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += size;
  }
  return record;
}

/** Makes a .zip of files, each as [name, bytes]. */
async function zipOf(files) {
  const deflate = 8;
  const utf8 = 0x800;
  const parts = [];
  const index = [];
  let at = 0;
  const add = (...pieces) => pieces.forEach((piece) => {
    parts.push(piece);
    at += piece.length;
  });
  for (const [name, bytes] of files) {
    const packed = await throughStream(bytes, new CompressionStream("deflate-raw"));
    const nameBytes = new TextEncoder().encode(name);
    const common = [[2, 20], [2, utf8], [2, deflate], [2, 0], [2, 0x21], [4, crcOf(bytes)], [4, packed.length],
      [4, bytes.length], [2, nameBytes.length], [2, 0]];
    index.push(zipRecord([4, 0x02014b50], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), nameBytes);
    add(zipRecord([4, 0x04034b50], ...common), nameBytes, packed);
  }
  const start = at;
  add(...index);
  add(zipRecord([4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, at - start], [4, start],
    [2, 0]));
  return new Blob(parts, { type: "application/zip" });
}

/** Offers a file for download. */
function download(blob, name) {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

const base64Of = (bytes) => {
  let text = "";
  for (let k = 0; k < bytes.length; k += 0x8000) text += String.fromCharCode(...bytes.subarray(k, k + 0x8000));
  return btoa(text);
};
const bytesOfBase64 = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

const longestLink = 30000; // longest link [characters]; a longer scene gets none

/** The part of an address after "#" that contains a scene; null if it would be too long. */
async function linkOfScene(text) {
  const packed = await throughStream(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const words = base64Of(packed).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  return words.length <= longestLink ? `#scene=${words}` : null;
}

/** The scene in such an address; null if there is none. */
async function sceneOfLink(hash) {
  const words = /^#scene=([\w-]+)$/.exec(hash)?.[1];
  if (!words) return null;
  const packed = bytesOfBase64(words.replaceAll("-", "+").replaceAll("_", "/"));
  return new TextDecoder().decode(await throughStream(packed, new DecompressionStream("deflate-raw")));
}
