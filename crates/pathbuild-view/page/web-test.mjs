// Tests the page without a server: node web-test.mjs PATHBUILD LIBRARY HTML [PICTURES]. Needs Debian's chromium.
import { spawnSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import assert from "node:assert/strict";
import { unzipSync } from "fflate";
import { launch } from "./browser.mjs";

const [pathbuild, given, html, pictures] = process.argv.slice(2).map((argument) => resolve(argument));
const place = mkdtempSync(join(tmpdir(), "pathbuild-web-"));
const library = join(place, "library");
cpSync(given, library, { recursive: true });
rmSync(join(library, "gcode"), { recursive: true, force: true });

const browser = await launch();

/** Opens the page from a file. Errors and requests to any server fail the test. */
async function open(options = {}, file = html) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, locale: "en", ...options });
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("request", (request) => request.url().startsWith(`file://${file}`) || /^(data|blob):/.test(request.url()) || faults.push(request.url()));
  await page.goto(`file://${file}`);
  await page.waitForSelector("html[data-ready]");
  return { page, faults };
}

async function shot(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
}

const text = (page, selector) => page.locator(selector).innerText();
const checked = (page, paths) => page.waitForFunction((paths) => document.getElementById("count").textContent === `${paths} paths`, paths, { timeout: 120_000 });

/** The files that a click downloads, by name. */
async function downloaded(page, button) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  const bytes = readFileSync(await download.path());
  const name = download.suggestedFilename();
  return name.endsWith(".zip") ? unzipSync(bytes) : { [name]: bytes };
}

/** Runs the command-line program. */
function run(...line) {
  const done = spawnSync(pathbuild, [...line, "--no-cache"], { cwd: library, encoding: "utf8", maxBuffer: 1 << 28 });
  assert.equal(done.error, undefined);
  return done;
}

/** All files below a folder. */
function all(folder) {
  return readdirSync(folder, { recursive: true }).filter((name) => statSync(join(folder, name)).isFile());
}

{
  const { page, faults } = await open();
  assert.match(await text(page, "#drop"), /Nothing leaves this machine/);
  await shot(page, "web-empty");
  // A folder: the paths of the library in its configuration, with the states and figures of `list`.
  const listed = JSON.parse(`[${run("list", "--format", "json").stdout.trim().split("\n").join(",")}]`).filter((row) => row.type === "path");
  const begun = Date.now();
  await page.setInputFiles("#folder", library);
  await page.waitForSelector(".item");
  await checked(page, listed.length);
  await page.waitForSelector("#filter-ok");
  console.log(`${listed.length} paths of the library opened and checked: ${Date.now() - begun} ms`);
  assert.equal(await text(page, "#filter-ok"), `ok ${listed.filter((row) => row.state === "ok").length}`);
  await shot(page, "web-library");
  await page.click("#totals");
  assert.match(await text(page, "#statistics"), /cutter O/);
  await page.click("#totals");
  // All programs, byte for byte as `emit` writes them.
  const programs = await downloaded(page, "#download-all");
  const emitted = run("emit");
  assert.equal(emitted.status, 0, emitted.stderr);
  const written = all(join(library, "gcode"));
  assert.ok(written.length >= 5, String(written));
  assert.deepEqual(Object.keys(programs).sort(), written.map((name) => `gcode/${name}`).sort());
  for (const name of written) assert.ok(readFileSync(join(library, "gcode", name)).equals(programs[`gcode/${name}`]), name);
  assert.match(await text(page, "#said"), /8001\.1P_Milling\.gcode/);
  // One path: picture, G-code, program.
  await page.fill("#search", "8001.1P");
  await page.locator(".item").first().click();
  await page.waitForFunction(() => document.getElementById("title").textContent === "8001.1P");
  assert.match(await text(page, "#code"), /Path 8001\.1P|G0/);
  const single = await downloaded(page, "#download");
  assert.deepEqual(Object.keys(single), ["8001.1P_Milling.gcode"]);
  assert.ok(readFileSync(join(library, "gcode/8001.1P_Milling.gcode")).equals(single["8001.1P_Milling.gcode"]));
  await page.keyboard.press("Home");
  for (let step = 0; step < 3; step++) await page.keyboard.press("ArrowRight");
  assert.match(await text(page, "#where"), /^Move 3 of/);
  await shot(page, "web-path");
  // Through a post: the page asks for a value that the control needs and that is not stated, and then gets it.
  await page.keyboard.press("Escape");
  await page.fill("#search", "");
  await page.selectOption("#post", "linuxcnc");
  await checked(page, listed.length);
  await page.click("#download-all");
  await page.waitForFunction(() => /PB754/.test(document.getElementById("said").textContent));
  const configuration = readFileSync(join(library, "pathbuild.toml"), "utf8");
  await page.click("#configure");
  assert.equal(await page.inputValue("#toml"), configuration);
  const manual = `spindle = "manual"\n${configuration}`;
  await page.fill("#toml", manual);
  await page.locator("#toml").blur();
  await page.click("#configure");
  await checked(page, listed.length);
  writeFileSync(join(library, "pathbuild.toml"), manual);
  const posts = await page.locator("#post option").evaluateAll((options) => options.map((option) => option.value).filter((name) => name !== "" && name !== "native"));
  assert.ok(posts.length >= 7, String(posts));
  for (const post of posts) {
    await page.selectOption("#post", post);
    await page.evaluate(() => (location.hash = `#${new URLSearchParams({ file: "projects/8001.1P.dxf", path: "8001.1P" })}`));
    await page.waitForFunction(() => document.getElementById("title").textContent === "8001.1P" && !document.getElementById("viewer").hidden);
    const [program] = Object.values(await downloaded(page, "#download"));
    const own = spawnSync(pathbuild, ["emit", "8001.1P", "--post", post, "--no-cache", "-o", "-"], { cwd: library });
    assert.ok(own.stdout.length > 1000 && own.stdout.equals(Buffer.from(program)), post);
    const first = own.stdout.toString("latin1").split(/\r?\n/).find((line) => line.trim() !== "");
    // Only visible rows are rendered, and those of the last move are visible.
    await page.evaluate(() => (document.getElementById("code").scrollTop = 0));
    await page.waitForFunction((row) => document.getElementById("code").textContent.includes(row), first.trim(), { timeout: 5000 });
    // Moves lead to lines of this file, and back from the native text.
    for (let step = 0; step < 5; step++) await page.keyboard.press("ArrowLeft");
    const number = Number(await page.locator(".row.now i").innerText());
    const lines = own.stdout.toString("latin1").split("\n").map((line) => line.trim());
    assert.equal((await page.locator(".row.now span").innerText()).trim(), lines[number - 1], post);
    assert.match(await text(page, "#whose"), /8001\.1P_Milling\./);
    await page.click("#native");
    assert.match(await text(page, ".row.now"), /G0[0-3]/);
    assert.match(await text(page, "#whose"), /^native program/);
    await page.click("#native");
    await page.keyboard.press("Escape");
  }
  // The page does not know where the download is stored.
  await checked(page, listed.length);
  await page.waitForSelector("#filter-ok");
  assert.equal(await text(page, "#filter-ok"), `ok ${listed.length}`);
  await shot(page, "web-post");
  // Language and colours by keys, as on the served page.
  await page.locator("#list").focus();
  await page.keyboard.press("l");
  assert.match(await text(page, "#drop"), /Nichts verlässt diesen Rechner/);
  assert.match(await text(page, "#count"), /Pfade$/);
  await page.keyboard.press("d");
  await shot(page, "web-german-other-colours");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // Drawings alone: the page asks for values that are not stated; a drawing that comes again replaces itself.
  const { page, faults } = await open();
  const drawing = join(library, "components/2050.1P.dxf");
  await page.setInputFiles("#drawings", [drawing, join(library, "mistakes/3001.1P.dxf")]);
  await checked(page, 2);
  await page.waitForSelector("#filter-errors");
  await page.click("#download-all");
  await page.waitForFunction(() => /missing: /.test(document.getElementById("said").textContent));
  for (const [field, value] of [["feed", "150"], ["sweep-height", "20"]]) {
    await page.fill(`#${field}`, value);
    await page.locator(`#${field}`).blur();
  }
  await checked(page, 2);
  // Beside an open path, its values can still be typed in, and the field beside the picture is one of them.
  await page.locator(".item", { hasText: "2050.1P" }).first().click();
  await page.waitForSelector("#typeRapid:not([hidden])");
  assert.ok(await page.locator("#feed").isVisible());
  await page.fill("#assumedRapid", "1000");
  await page.locator("#assumedRapid").blur();
  await page.waitForSelector("#typeRapid", { state: "hidden" });
  assert.equal(await page.inputValue("#rapid"), "1000");
  await page.keyboard.press("Escape");
  await checked(page, 2);
  const programs = await downloaded(page, "#download-all");
  assert.deepEqual(Object.keys(programs), ["2050.1P_Milling.gcode"]);
  run("emit", "components/2050.1P.dxf", "--out-dir", join(place, "alone"));
  assert.ok(readFileSync(join(place, "alone/2050.1P_Milling.gcode")).equals(programs["2050.1P_Milling.gcode"]));
  // A finding with its place.
  await page.fill("#search", "3001");
  await page.locator(".item").first().click();
  await page.waitForFunction(() => /PB401/.test(document.getElementById("findings").textContent));
  await shot(page, "web-mistake");
  await page.keyboard.press("Escape");
  await page.fill("#search", "");
  writeFileSync(drawing, readFileSync(drawing, "latin1").replaceAll(/2050(\.|\D)1P/g, "2050$19P"), "latin1");
  await page.setInputFiles("#drawings", drawing);
  // Rows come one by one: the first is shown before the second is listed.
  await page.waitForFunction(() => /2050\.9P/.test(document.getElementById("items").textContent) && document.querySelectorAll(".item").length === 2);
  // A wrong value, a wrong configuration.
  await page.fill("#feed", "fast");
  await page.locator("#feed").blur();
  await page.waitForSelector("#trouble:not([hidden])");
  assert.match(await text(page, "#trouble"), /--feed/);
  await page.fill("#feed", "100");
  await page.locator("#feed").blur();
  await page.waitForSelector("#trouble", { state: "hidden" });
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // Dropped files, including a folder within a folder.
  const { page, faults } = await open();
  const files = all(library).filter((name) => !name.startsWith("gcode")).map((name) => [name, readFileSync(join(library, name), "base64")]);
  const transfer = await page.evaluateHandle((files) => {
    const data = new DataTransfer();
    for (const [name, bytes] of files) data.items.add(new File([Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0))], name.split("/").pop()));
    return data;
  }, files.filter(([name]) => /2051|2052|2053/.test(name)));
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await page.waitForFunction(() => /2053\.1P/.test(document.getElementById("items").textContent));
  // As a user does it: a folder from the file manager, and then a drawing.
  const client = await page.context().newCDPSession(page);
  const drop = async (...files) => {
    for (const type of ["dragEnter", "dragOver", "drop"]) await client.send("Input.dispatchDragEvent", { type, x: 600, y: 400, data: { items: [], files, dragOperationsMask: 1 } });
  };
  const rows = JSON.parse(`[${run("list", "--format", "json").stdout.trim().split("\n").join(",")}]`).filter((row) => row.type === "path");
  assert.ok(rows.length > 20, `${rows.length} paths`);
  await drop(library);
  await checked(page, rows.length);
  await page.waitForSelector("#filter-ok");
  const programs = await downloaded(page, "#download-all");
  run("emit");
  for (const [name, bytes] of Object.entries(programs)) assert.ok(readFileSync(join(library, name)).equals(Buffer.from(bytes)), name);
  assert.ok(Object.keys(programs).length >= 5, Object.keys(programs).join());
  const again = join(place, "2052.1P.dxf");
  writeFileSync(again, readFileSync(join(library, "components/2052.1P.dxf"), "latin1").replaceAll("2052.1P", "2052.9P"), "latin1");
  await page.fill("#search", "205");
  await drop(again);
  await page.waitForFunction(() => /2052\.9P[^]*2053\.1P/.test(document.getElementById("items").textContent));
  // More than the page can hold.
  const huge = join(place, "huge");
  mkdirSync(huge);
  for (let number = 0; number < 20_001; number++) writeFileSync(join(huge, `${number}.txt`), "");
  await page.setInputFiles("#folder", huge);
  await page.waitForFunction(() => /more than this page can hold/.test(document.getElementById("said").textContent), undefined, { timeout: 120_000 });
  assert.match(await text(page, "#said"), /20001 files/);
  assert.match(await text(page, "#items"), /2053\.1P/);
  assert.deepEqual(faults, []);
  await page.close();
}

/** A page whose compiler fails on one path until it is told that this path was lost. */
function broken(way) {
  const change = `const first=WebAssembly.instantiate;WebAssembly.instantiate=async(...given)=>{
    const own=(await first(...given)).instance.exports;let room=0,length=0,known=false;
    const answer=()=>{
      const question=new TextDecoder().decode(new Uint8Array(own.memory.buffer,room,length)).split("\\n")[0];
      if(/"ask":"open".*2052/.test(question))known=true;
      if(!known&&/"ask":"(check|scene)".*2052/.test(question)){${way}}
      return own.answer();
    };
    return{instance:{exports:{...own,answer,room:(n)=>(length=n,room=own.room(n)>>>0)}}};
  };`;
  const file = join(place, `broken-${broken.count = (broken.count ?? 0) + 1}.html`);
  const page = readFileSync(html, "utf8");
  const mark = '<script type="text/plain" id="worker">';
  assert.ok(page.includes(mark));
  writeFileSync(file, page.replace(mark, () => mark + change));
  return file;
}
for (const [way, code] of [["own.room(-1)", "PB006"], ["for(;;);", "PB005"], ["(function deeper(){return deeper()+1})()", "PB006"]]) {
  // A path that terminates the compiler has a finding; all others are unchanged.
  const { page, faults } = await open({}, broken(way));
  const drawings = ["2051.1P", "2052.1P", "2053.1P"].map((name) => join(library, `components/${name}.dxf`));
  writeFileSync(join(place, "pathbuild.toml"), "feed = 150\nrapid = 1000\nsweep-height = 20\n[limits]\nseconds-per-path = 1\n");
  await page.setInputFiles("#drawings", [...drawings, join(place, "pathbuild.toml")]);
  await checked(page, 3);
  await page.waitForSelector("#filter-errors");
  assert.equal(await text(page, "#filter-errors"), "errors 1");
  assert.equal(await text(page, "#filter-ok"), "ok 2");
  await page.fill("#search", "2052");
  await page.locator(".item").first().click();
  await page.waitForFunction((code) => document.getElementById("findings").textContent.includes(code), code);
  await shot(page, `web-${code}`);
  await page.keyboard.press("Escape");
  await page.fill("#search", "2053");
  await page.locator(".item").first().click();
  await page.waitForFunction(() => document.getElementById("title").textContent === "2053.1P");
  assert.deepEqual(Object.keys(await downloaded(page, "#download")), ["2053.1P_Milling.gcode"]);
  assert.deepEqual(faults, []);
  await page.close();
}

/** A drawing in a code page: all pairs of bytes of which the first is not ASCII, beside others and alone; and longer ones of GBK. */
function codePage(name) {
  const bytes = (from) => Array.from({ length: 256 - from }, (_, index) => from + index);
  const texts = bytes(0x80).flatMap((first) => [
    bytes(0x20).flatMap((second) => [0x2e, first, second, 0x2e]),
    bytes(0x20).flatMap((second) => [first, second, first, second, 0x41]),
    [0x2e, first],
  ]);
  for (let first = 0x81; first < 0xff; first++) texts.push([0x30, 0x35, 0x39].flatMap((second) => [0x81, 0x9f, 0xfe].flatMap((third) => [first, second, third, second, 0x2e])));
  const lines = (...said) => Buffer.from(said.map((line) => `${line}\n`).join(""), "latin1");
  const text = (said) => [lines(0, "TEXT", 8, "words", 10, 0, 20, 0, 40, 2, 1), Buffer.from(said), lines("")];
  const head = lines(0, "SECTION", 2, "HEADER", 9, "$ACADVER", 1, "AC1015", 9, "$DWGCODEPAGE", 3, name, 0, "ENDSEC", 0, "SECTION", 2, "ENTITIES");
  return Buffer.concat([head, ...texts.flatMap(text), lines(0, "LINE", 8, "1000.1P", 6, "CONTINUOUS", 10, 0, 20, 0, 11, 9, 21, 0, 0, "ENDSEC", 0, "EOF")]);
}

/** In the page: the pictures of each drawing by its compiler. */
async function scenesOf(drawings) {
  const inside = (id) => document.getElementById(id).textContent;
  const packed = Uint8Array.from(atob(inside("wasm")), (letter) => letter.charCodeAt(0));
  const wasm = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  const worker = new Worker(URL.createObjectURL(new Blob([inside("worker")], { type: "text/javascript" })));
  const ask = (question, bytes) =>
    new Promise((answer) => {
      worker.onmessage = ({ data }) => answer(new TextDecoder().decode(data.bytes));
      worker.postMessage({ head: JSON.stringify(question), bytes });
    });
  worker.postMessage(wasm);
  for (const [file, bytes] of drawings) await ask({ ask: "put", file }, Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0)).buffer);
  await ask({ ask: "open", options: {} });
  const scenes = [];
  for (const [file] of drawings) scenes.push(await ask({ ask: "scene", file, path: null }));
  return scenes;
}
{
  // Code pages: the browser decodes texts exactly as the program does, damaged ones too.
  const folder = join(place, "pages");
  mkdirSync(folder);
  writeFileSync(join(folder, "pathbuild.toml"), "");
  const pages = ["ANSI_866", "ANSI_874", "ANSI_932", "ANSI_936", "ANSI_949", "ANSI_950", "ANSI_1250", "ANSI_1251", "ANSI_1252", "ANSI_1253", "ANSI_1254", "ANSI_1255", "ANSI_1256", "ANSI_1257", "ANSI_1258", "DOS437", "DOS850", "ISO8859-2", "ISO8859-3", "ISO8859-4", "ISO8859-5", "ISO8859-6", "ISO8859-7", "ISO8859-8", "MACINTOSH", "UTF-8"];
  for (const name of pages) writeFileSync(join(folder, `${name}.dxf`), codePage(name));
  const { page, faults } = await open();
  const scenes = await page.evaluate(scenesOf, pages.map((name) => [`${name}.dxf`, readFileSync(join(folder, `${name}.dxf`), "base64")]));
  for (const [index, name] of pages.entries()) {
    const own = spawnSync(pathbuild, ["view", `${name}.dxf`, "-o", `${name}.json`, "--no-cache"], { cwd: folder, encoding: "utf8" });
    assert.ok(existsSync(join(folder, `${name}.json`)), own.stderr);
    const scene = readFileSync(join(folder, `${name}.json`), "utf8").trimEnd();
    const texts = JSON.parse(scene).other_layers.filter((it) => it.type === "text");
    assert.ok(texts.length >= 127 && texts.some((it) => /[^\0-\x7f\ufffd]/.test(it.text)), `${name}: ${texts.length}`);
    assert.ok(scene === scenes[index], name);
  }
  assert.deepEqual(faults, []);
  await page.close();
}

/** A drawing of a path that embeds the one before it; the first one mills a line. */
function level(number) {
  const layer = `${1000 + number}.1P`;
  const line = (kind, x1, y1, x2, y2) => `0 LINE 8 ${layer} 6 ${kind} 10 ${x1} 20 ${y1} 11 ${x2} 21 ${y2}`;
  const circle = (x, y, radius, kind) => `0 CIRCLE 8 ${layer} 6 ${kind} 10 ${x} 20 ${y} 40 ${radius}`;
  const words = (x, y, said) => [`0 TEXT 8 ${layer} 10 ${x} 20 ${y} 40 2 1`, said];
  const parts = [
    circle(0, 0, 0.5, "PHANTOM"),
    words(-1, 1, number === 0 ? "T5 O2 I1 B3 MX" : "T5 O2 S40 MX"),
    line("HIDDEN", 0, 0, 20, 0),
    line(number === 0 ? "CONTINUOUS" : "DASHDOT", 20, 0, 30, 0),
    number === 0 ? [] : words(18.4, -0.5, `>${999 + number}.1P H1`),
    line("HIDDEN", 30, 0, 10, 0),
    circle(10, 0, 1, "PHANTOM"),
  ];
  const lines = parts.flat().flatMap((part) => (/^0 /.test(part) ? part.split(" ") : [part]));
  return ["0", "SECTION", "2", "ENTITIES", ...lines, "0", "ENDSEC", "0", "EOF", ""].join("\n");
}
{
  // Deep nesting, where stacks are small: the results and refusals are those of the program.
  const deep = join(place, "deep");
  mkdirSync(deep);
  writeFileSync(join(deep, "pathbuild.toml"), "feed = 150\nrapid = 1000\nsweep-height = 40\n");
  for (let number = 0; number < 40; number++) writeFileSync(join(deep, `${1000 + number}.1P.dxf`), level(number));
  const rows = spawnSync(pathbuild, ["list", "--no-cache", "--format", "json"], { cwd: deep, encoding: "utf8" }).stdout.trim().split("\n").map((row) => JSON.parse(row));
  const count = (state) => rows.filter((row) => row.type === "path" && row.state === state).length;
  assert.ok(count("ok") >= 10 && count("errors") >= 20, JSON.stringify([count("ok"), count("errors")]));
  const { page, faults } = await open();
  await page.setInputFiles("#folder", deep);
  await checked(page, 40);
  await page.waitForSelector("#filter-errors");
  assert.equal(await text(page, "#filter-ok"), `ok ${count("ok")}`);
  assert.equal(await text(page, "#filter-errors"), `errors ${count("errors")}`);
  await page.fill("#search", "1039");
  await page.locator(".item").first().click();
  await page.waitForFunction(() => /PB508/.test(document.getElementById("findings").textContent));
  await page.keyboard.press("Escape");
  await page.fill("#search", "");
  const programs = await downloaded(page, "#download-all");
  assert.equal(Object.keys(programs).length, count("ok"));
  for (const [name, bytes] of Object.entries(programs)) {
    const own = spawnSync(pathbuild, ["emit", name.replace("_Milling.gcode", ""), "--no-cache", "-o", "-"], { cwd: deep });
    assert.ok(own.stdout.equals(Buffer.from(bytes)), name);
  }
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // On a phone.
  const { page, faults } = await open({ viewport: { width: 390, height: 800 }, colorScheme: "dark", locale: "de" });
  await page.setInputFiles("#folder", library);
  await page.waitForSelector("#filter-ok");
  assert.match(await text(page, "#count"), /Pfade$/);
  await shot(page, "web-library-390");
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.fill("#search", "8001.1P");
  await page.locator(".item").first().click();
  await page.waitForFunction(() => document.getElementById("title").textContent === "8001.1P");
  await shot(page, "web-path-390");
  await page.click("#back");
  assert.ok(await page.locator("#library").isVisible());
  assert.deepEqual(faults, []);
  await page.close();
}
await browser.close();
rmSync(place, { recursive: true });
console.log("page in the browser alone: all passed");
