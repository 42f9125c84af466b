// Bundles the page and writes it as a C++ source (results/page_files.h).
//
//   node build.mjs SOURCE_FOLDER OUTPUT.cpp
//
// Runs in the build folder, where `npm ci` has put node_modules.
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';

const [sources, output] = process.argv.slice(2);
const here = createRequire(path.join(process.cwd(), 'package.json'));
const { build } = await import(here.resolve('esbuild'));

const DELIMITER = 'conebench_page';

async function bundle(entry) {
  const result = await build({
    entryPoints: [path.join(sources, entry)],
    bundle: true,
    minify: true,
    write: false,
    legalComments: 'inline', // licences of what is bundled stay with it
    target: 'es2022',
    nodePaths: [path.join(process.cwd(), 'node_modules')],
  });
  return result.outputFiles[0].text.trim();
}

// A string literal may be too long for a compiler; its pieces are joined by it.
function literal(text) {
  if (text.includes(`)${DELIMITER}"`)) throw new Error('the delimiter is in the text');
  const pieces = [];
  for (let start = 0; start < text.length; start += 16000) {
    pieces.push(`R"${DELIMITER}(${text.slice(start, start + 16000)})${DELIMITER}"`);
  }
  return pieces.join('\n');
}

async function licence(name) {
  const text = await readFile(path.join(process.cwd(), 'node_modules', name, 'LICENSE'), 'utf8');
  return `/*! ${name}\n${text.trim().replaceAll('*/', '* /')}\n*/\n`;
}

const style = await bundle('page.css');
const script = (await licence('uplot')) + (await bundle('page.js'));
const view = (await licence('three')) + (await bundle('view.js'));
await writeFile(
  output,
  `// Written by build.mjs.
#include "results/page_files.h"

namespace conebench::results {
namespace {
constexpr char kStyle[] = ${literal(style)};
constexpr char kScript[] = ${literal(script)};
constexpr char kView[] = ${literal(view)};

// Without counting its letters at compile time.
template <std::size_t size>
std::string_view text(const char (&letters)[size]) {
  return {letters, size - 1};
}
}  // namespace

std::optional<PageFiles> page_files() {
  return PageFiles{text(kStyle), text(kScript), text(kView)};
}

}  // namespace conebench::results
`,
);
