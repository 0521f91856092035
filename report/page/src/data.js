// The data in the page: the table, and images as report/encode.h writes them.

const elementText = (id) => document.getElementById(id)?.textContent ?? '';

/** The trade table, with what may be missing from it filled in. */
export function readTable() {
  const table = JSON.parse(elementText('trade-table') || '{}');
  return {
    ...table,
    runs: table.runs ?? [],
    knobs: table.knobs ?? [],
    words: table.words ?? [],
    notes: table.notes ?? [],
    tables: table.tables ?? [],
    machine: table.machine ?? {},
    reference: table.reference ?? {},
  };
}

/** What is embedded: {images: key -> {element, width, height, kind}, left_out, budget_bytes}. */
export const readCatalogue = () =>
  JSON.parse(elementText('trade-images') || '{"images": {}, "left_out": []}');

/** Every half float as a number, by its bits. */
export const HALF_VALUES = Float32Array.from({length: 65536}, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const mantissa = bits & 1023;
  if (exponent === 0) return sign * mantissa * 2 ** -24;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (1024 + mantissa) * 2 ** (exponent - 25);
});

async function inflate(text) {
  const packed = Uint8Array.from(atob(text), (char) => char.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Undoes the differences along a plane of 16-bit numbers whose bytes start at `offset`. */
function summedPlane(bytes, offset, length) {
  const plane = new Uint16Array(length);
  let sum = 0;
  for (let i = 0; i < length; i += 1) {
    sum = (sum + (bytes[offset + i] << 8) + bytes[offset + length + i]) & 0xffff;
    plane[i] = sum;
  }
  return plane;
}

/** Bits of halves: {width, height, planes: [R, G, B]}. */
function decodeColour({width, height}, bytes) {
  const length = width * height;
  const [g, r, b] = [0, 2, 4].map((plane) => summedPlane(bytes, plane * length, length));
  for (let i = 0; i < length; i += 1) {
    r[i] += g[i];
    b[i] += g[i];
  }
  return {width, height, planes: [r, g, b]};
}

/** {width, height, values: Float32Array}. */
function decodeScalar({width, height}, bytes) {
  const length = width * height;
  const view = new DataView(new ArrayBuffer(length * 4));
  for (let place = 0; place < 4; place += 1) {
    for (let i = 0; i < length; i += 1) view.setUint8(4 * i + place, bytes[place * length + i]);
  }
  const values = new Float32Array(length);
  for (let i = 0; i < length; i += 1) values[i] = view.getFloat32(4 * i);
  return {width, height, values};
}

/** Decodes images when they are first asked for; keeps the `most` that were asked for last. */
export function createImageStore(catalogue, most = 12) {
  const cache = new Map();
  const decode = async (entry) => {
    const bytes = await inflate(elementText(entry.element));
    return entry.kind === 'scalar' ? decodeScalar(entry, bytes) : decodeColour(entry, bytes);
  };
  return {
    has: (key) => Object.hasOwn(catalogue.images, key ?? ''),
    /** A promise of the image; null when it is not in the page. */
    async load(key) {
      if (!this.has(key)) return null;
      const image = cache.get(key) ?? decode(catalogue.images[key]);
      cache.delete(key);
      cache.set(key, image);
      if (cache.size > most) cache.delete(cache.keys().next().value);
      return image;
    },
  };
}
