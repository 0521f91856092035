// Bundles src/ into one HTML file and the C++ source that holds it.
// usage: node build.mjs FOLDER        FOLDER: where node_modules are, and where the results go
import {readFileSync, writeFileSync, mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const OLDEST_NODE = 18;
if (Number(process.versions.node.split('.')[0]) < OLDEST_NODE) {
  console.error(
    `error: Node.js ${process.versions.node} is too old: ${OLDEST_NODE} is the oldest that will do`,
  );
  process.exit(1);
}

const source = join(dirname(fileURLToPath(import.meta.url)), 'src');
const folder = resolve(process.argv[2] ?? '.');
const esbuild = createRequire(join(folder, 'package.json'))('esbuild');

/** One minified file, with everything that `entry` imports. */
function bundle(entry, options = {}) {
  const result = esbuild.buildSync({
    entryPoints: [join(source, entry)],
    bundle: true,
    minify: true,
    write: false,
    charset: 'ascii',
    legalComments: 'inline',
    nodePaths: [join(folder, 'node_modules')],
    target: ['chrome103', 'firefox113', 'safari16.4'],
    ...options,
  });
  return result.outputFiles[0].text;
}

/** Replaces a marker that has to be there once; `content` is taken literally. */
function put(html, marker, content) {
  const parts = html.split(marker);
  if (parts.length !== 2)
    throw new Error(`index.html: expected ${marker} once, found it ${parts.length - 1} times`);
  return parts.join(content);
}

/** A C++ literal of the bytes, in pieces that compilers take. */
function cppLiteral(text) {
  const lines = [];
  let line = '';
  for (const byte of Buffer.from(text, 'utf8')) {
    const char = String.fromCharCode(byte);
    if (char === '\\' || char === '"' || char === '?') line += '\\' + char;
    else if (byte >= 32 && byte < 127) line += char;
    else line += '\\' + byte.toString(8).padStart(3, '0');
    if (line.length > 110) {
      lines.push(line);
      line = '';
    }
  }
  lines.push(line);
  return lines.map((part) => `    "${part}"`).join('\n');
}

let html = readFileSync(join(source, 'index.html'), 'utf8');
html = put(html, '/*STYLE*/', bundle('style.css').trim());
html = put(html, '/*SCRIPT*/', bundle('main.js', {format: 'iife'}).trim());

mkdirSync(folder, {recursive: true});
writeFileSync(join(folder, 'page.html'), html);
writeFileSync(
  join(folder, 'page_template.cpp'),
  `// Generated from report/page/.
#include "report/page_template.h"

namespace tessera {

std::string_view report_page_template() {
  static constexpr char html[] =
${cppLiteral(html)};
  return {html, sizeof(html) - 1};
}

}  // namespace tessera
`,
);
