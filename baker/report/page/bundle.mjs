// SPDX-License-Identifier: Apache-2.0
// template.html, style.css and src/ -> ../page.html, which the program embeds. With --check, compares instead.
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import * as esbuild from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));
const target = path.join(here, '..', 'page.html');
const filledByTheProgram = ['<!-- title of the report -->', '<!-- data of the report -->'];

/** The licences of what is bundled ask to stay with it. */
function licences() {
  const texts = ['three', 'uplot'].map((name) => `${name}\n\n${readFileSync(path.join(here, 'node_modules', name, 'LICENSE'), 'utf8')}`);
  return `/*! This script holds surimi-three and surimi-glb (Apache-2.0) and\n\n${texts.join('\n')}\nThe tables of linearly ` +
    'transformed cosines in it are those of Heitz, Dupuy, Hill and Neubelt 2016. */';
}

async function bundled(entry, banner = '') {
  const result = await esbuild.build({
    entryPoints: [path.join(here, entry)],
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2022',
    charset: 'ascii',
    banner: { js: banner },
    preserveSymlinks: true, // surimi-three takes the three of the page
    write: false,
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

/** The parts of a page that the browser reads as text must not hold what ends them. */
function fill(page, mark, content) {
  const parts = page.split(mark);
  if (parts.length !== 2) throw new Error(`"${mark}" must be there once`);
  if (/<\/(script|style)|<!--/i.test(content)) throw new Error(`what goes in the place of "${mark}" would end its element`);
  return parts.join(content);
}

const script = (await bundled('src/main.js', licences())).replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const hash = createHash('sha256').update(script).digest('base64');
let page = readFileSync(path.join(here, 'template.html'), 'utf8');
page = fill(page, '<!-- hash of the script -->', `'sha256-${hash}'`);
page = fill(page, '<!-- style -->', await bundled('style.css'));
page = fill(page, '<!-- script -->', script);
for (const mark of filledByTheProgram)
  if (page.split(mark).length !== 2) throw new Error(`"${mark}" must be there once`);

if (process.argv.includes('--check')) {
  if (readFileSync(target, 'utf8') !== page) {
    console.error('baker/report/page.html is not what its sources make: run npm ci && node bundle.mjs in baker/report/page');
    process.exit(1);
  }
} else {
  writeFileSync(target, page);
  console.log(`${target}: ${page.length} bytes`);
}
