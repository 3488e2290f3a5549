// Installs the npm package in a new directory, and compares it with the program over a library: node packaging/npm/test.mjs PATHBUILD LIBRARY PACKAGE.tgz
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";

const [program, library, archive] = process.argv.slice(2).map((argument) => resolve(argument));
const root = new URL("../..", import.meta.url).pathname;
const place = mkdtempSync(join(tmpdir(), "pathbuild-npm-"));
after(() => rmSync(place, { recursive: true }));
cpSync(library, place, { recursive: true });
rmSync(join(place, "gcode"), { recursive: true, force: true });
const files = readdirSync(place, { recursive: true }).filter((name) => statSync(join(place, name)).isFile());
writeFileSync(join(place, "package.json"), "{}");
execFileSync("npm", ["install", "--silent", "--offline", "--no-audit", "--no-fund", archive], { cwd: place });

const installed = join(place, "node_modules/pathbuild");
const { load } = await import(pathToFileURL(join(installed, "index.js")));
const module = await WebAssembly.compile(readFileSync(join(installed, "pathbuild.wasm")));

/** The compiler with the library's files. */
async function filled() {
  const pathbuild = await load(module);
  for (const file of files) pathbuild.put(file, readFileSync(join(place, file)));
  return pathbuild;
}

function run(...line) {
  return spawnSync(program, [...line, "--no-cache"], { cwd: place, encoding: "utf8", maxBuffer: 1 << 28 });
}

const pathbuild = await filled();
const { halted, drawings } = pathbuild.open();
const places = drawings.flatMap((file) => pathbuild.paths(file).map(({ path }) => ({ file, path })));

test("paths are those of `list`", () => {
  assert.equal(halted, null);
  const lines = run("list", "--format", "json").stdout.trim().split("\n").map(JSON.parse);
  const listed = lines.filter(({ type }) => type === "path").map(({ type, ...row }) => row);
  const by = (a, b) => (a.path < b.path ? -1 : 1);
  assert.deepEqual(places.map(({ file, path }) => pathbuild.check(file, path)).sort(by), listed.sort(by));
  assert.equal(pathbuild.statistics().paths, listed.length);
  assert.ok(listed.length > 30);
});

test("programs are those of `emit`", () => {
  const { file, path } = places.find(({ path }) => path === "8001.1P");
  const { refused, problems, files } = pathbuild.emit([{ file, path }]);
  assert.deepEqual([refused, problems.filter(({ is_error }) => is_error)], [null, []]);
  run("emit", path);
  assert.deepEqual(files.map(({ name, bytes }) => [name, Buffer.from(bytes).toString()]), [[files[0].name, readFileSync(join(place, files[0].name), "utf8")]]);
});

test("a scene is that of `view`", () => {
  const { file, path } = places.find(({ path }) => path === "2050.1P");
  run("view", path, "-o", "scene.json");
  assert.deepEqual(pathbuild.scene(file, path), JSON.parse(readFileSync(join(place, "scene.json"), "utf8")));
  assert.match(pathbuild.picture(file, path), /^<svg/);
  assert.equal(pathbuild.scene(file, "9999.9P"), null);
});

test("a wrong configuration halts", async () => {
  const other = await filled();
  other.put("pathbuild.toml", "feed = 'fast'");
  const { halted, problems } = other.open();
  assert.notEqual(halted, null);
  assert.equal(problems[0].code, "PB003");
  assert.throws(() => other.paths(drawings[0]), /nothing is open/);
});

/** What the first example of a page prints. */
function example(page) {
  writeFileSync(join(place, "example.mjs"), readFileSync(page, "utf8").match(/```js\n(.*?)```/s)[1]);
  return execFileSync("node", ["example.mjs"], { cwd: place, encoding: "utf8" });
}

test("the examples of the books run", () => {
  for (const lang of ["en", "de"]) assert.match(example(resolve(root, `docs/${lang}/src/howto/javascript.md`)), /^ok \d/);
});

test("the example of the README runs", () => {
  const printed = example(join(installed, "README.md"));
  assert.match(printed, /components\/2050\.1P\.dxf: 2050\.1P is ok/);
  assert.match(printed, /_Milling\.gcode: \d+ bytes/);
});
