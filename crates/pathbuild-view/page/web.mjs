// Builds the page without a server: node web.mjs WASM HTML [ADDRESS OF THE BOOK]. It is a single file that contains the compiler and its worker.
import { readFileSync, writeFileSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const [wasm, html, book = "https://example.invalid/pathbuild"] = process.argv.slice(2);
const here = (name) => new URL(name, import.meta.url).pathname;
const text = (name) => readFileSync(here(name), "utf8");

/** Bundles a script so that it cannot end the element that contains it. */
async function script(entry, format) {
  const { outputFiles } = await build({ entryPoints: [here(entry)], bundle: true, minify: true, write: false, format, target: "es2022", charset: "utf8", legalComments: "eof" });
  return outputFiles[0].text.replaceAll("</script", "<\\/script").trim();
}

/** Compresses as well as possible: Zopfli, if installed, saves another five percent. */
function pack(file) {
  const zopfli = spawnSync("zopfli", ["--i5", "-c", file], { maxBuffer: 1 << 28 });
  return zopfli.status === 0 ? zopfli.stdout : gzipSync(readFileSync(file), { level: 9 });
}

const packed = pack(wasm);
const parts = {
  style: ["style.css", "live.css", "local.css"].map(text).join(""),
  viewer: text("viewer.html").replaceAll(/\{\{\w+\}\}/g, ""),
  worker: await script("src/worker.ts", "iife"),
  script: await script("src/local.ts", "esm"),
  wasm: packed.toString("base64"),
  book,
};
writeFileSync(html, text("local.html").replaceAll(/\{\{(\w+)\}\}/g, (_, name) => parts[name]));
console.log(`${html}: ${readFileSync(html).length} bytes, the compiler ${packed.length} of them (gzip)`);
