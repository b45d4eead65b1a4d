// SPDX-License-Identifier: Apache-2.0
// A headless Chromium that shows one bundled script and reads files of the test, without a server.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import * as esbuild from 'esbuild';
import { chromium } from 'playwright-core';

const here = path.dirname(fileURLToPath(import.meta.url));
const origin = 'http://surimi.test';
const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const types = { '.glb': 'model/gltf-binary', '.png': 'image/png', '.html': 'text/html', '.js': 'text/javascript' };

/** pages/NAME as one script. The packages under test take the three of the tests, as in a user's project. */
async function bundle(name) {
  const result = await esbuild.build({
    entryPoints: [path.join(here, 'pages', name)],
    bundle: true,
    format: 'iife',
    preserveSymlinks: true,
    write: false,
    logLevel: 'error',
  });
  return result.outputFiles[0].text;
}

/** The browser; close it with close(). */
export function launch() {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true, args: flags });
}

/**
 * A page with the script pages/NAME, in which /FILE is a file of `folder`. Returns the page and the list of everything
 * that went wrong in it: errors, warnings of the console, and requests to anywhere else.
 */
export async function open(browser, name, folder) {
  const page = await browser.newPage();
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning') complaints.push(message.text());
  });
  const script = await bundle(name);
  await page.route('**/*', (route) => {
    const { origin: asked, pathname } = new URL(route.request().url());
    if (asked !== origin) {
      complaints.push(`request to ${route.request().url()}`);
      return route.abort();
    }
    if (pathname === '/') return route.fulfill({ contentType: 'text/html', body: '<script src="/page.js"></script>' });
    if (pathname === '/page.js') return route.fulfill({ contentType: 'text/javascript', body: script });
    if (pathname === '/favicon.ico') return route.fulfill({ status: 204 });
    const contentType = types[path.extname(pathname)] ?? 'application/octet-stream';
    return route.fulfill({ contentType, body: readFileSync(path.join(folder, pathname)) });
  });
  await page.goto(origin);
  return { page, complaints };
}
