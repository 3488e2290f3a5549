// The page in a browser: node test.mjs PATHBUILD LIBRARY [PICTURES]; BROWSER=firefox tries Firefox.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join, resolve } from "node:path";
import assert from "node:assert/strict";
import { isFirefox, launch, launchWithoutWebGL } from "./browser.mjs";

const [pathbuild, library, pictures] = process.argv.slice(2).map((argument) => resolve(argument));
const directory = mkdtempSync(join(tmpdir(), "pathbuild-page-"));
const browser = await launch();

/** Writes a page and opens it. Errors and requests to other servers fail the test. */
async function open(what, options = {}, cwd = library) {
  const file = join(directory, `${basename(what)}.html`);
  const run = spawnSync(pathbuild, ["view", what, "-o", file], { cwd, encoding: "utf8" });
  assert.ok(run.stderr.includes(".html"), run.stderr);
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...options });
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("request", (request) => request.url().startsWith("file:") || faults.push(request.url()));
  await page.goto(`file://${file}`);
  await page.waitForSelector("html[data-ready]");
  return { page, faults };
}

async function shot(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}${isFirefox ? "-firefox" : ""}.png`) });
}

/** Waits until no label overlaps another or the legend, and none is cut off. Returns the number of visible labels. */
async function apart(page) {
  const wrong = () => {
    const box = (node) => (({ left, top, right, bottom }) => ({ left, top, right, bottom, says: node.textContent }))(node.getBoundingClientRect());
    const picture = box(document.getElementById("picture"));
    const seen = [...document.querySelectorAll("#labels > *")].filter((node) => getComputedStyle(node).visibility === "visible").map(box);
    const cut = seen.filter((a) => a.left < picture.left - 1 || a.right > picture.right + 1 || a.top < picture.top - 1 || a.bottom > picture.bottom + 1);
    const meets = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
    const legend = document.getElementById("legend");
    const others = legend.hidden ? [] : [box(legend)];
    const over = seen.filter((a, index) => [...others, ...seen.slice(0, index)].some((b) => meets(a, b)));
    return { seen: seen.length, cut: cut.map((it) => it.says), over: over.map((it) => it.says) };
  };
  const isWell = new Function(`const { cut, over } = (${wrong})(); return cut.length + over.length === 0;`);
  await page.waitForFunction(isWell, undefined, { timeout: 10_000 }).catch(() => {});
  const { seen, cut, over } = await page.evaluate(wrong);
  assert.deepEqual({ cut, over }, { cut: [], over: [] });
  return seen;
}

/** Takes a screenshot of an element once it no longer changes, because a busy machine paints late. One that still changes after 20 seconds is printed. */
async function steady(page, locator) {
  let before = await locator.screenshot();
  for (const end = Date.now() + 20_000; Date.now() < end; ) {
    await page.waitForTimeout(300);
    const now = await locator.screenshot();
    if (before.equals(now)) return now;
    const changed = await changes(page, before, now);
    before = now;
    if (Date.now() >= end) console.log(`still changing: ${(100 * changed).toFixed(3)} % of ${page.url()}`);
  }
  return before;
}

/** Returns the share of pixels by which two screenshots of the same size differ. */
async function changes(page, ...screenshots) {
  return page.evaluate(async (pictures) => {
    const [one, other] = await Promise.all(pictures.map(async (picture) => {
      const image = Object.assign(new Image(), { src: `data:image/png;base64,${picture}` });
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
      context.drawImage(image, 0, 0);
      return new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
    }));
    return one.filter((pixel, index) => pixel !== other[index]).length / one.length;
  }, screenshots.map((screenshot) => screenshot.toString("base64")));
}

const text = (page, selector) => page.locator(selector).innerText();

{
  const { page, faults } = await open("8001.1P");
  const total = Number(await page.locator("#slider").getAttribute("max"));
  assert.ok(total > 300, `${total} moves`);
  assert.ok((await apart(page)) > 40);
  await shot(page, "project");
  // The legend leaves the start marker free, unless it is hidden.
  const [zero, legend] = await Promise.all(["#labels .zero", "#legend"].map((selector) => page.locator(selector).boundingBox()));
  assert.ok(zero.x > legend.x + legend.width || zero.y + zero.height < legend.y, JSON.stringify([zero, legend]));
  // A picture that the browser has lost and restored looks as before.
  const before = await steady(page, page.locator("#picture"));
  await page.evaluate(async () => {
    const canvas = document.querySelector("#picture canvas:not(#flat)");
    const hear = (event) => new Promise((done) => canvas.addEventListener(event, () => setTimeout(done), { once: true }));
    const extension = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
    const lost = hear("webglcontextlost");
    extension.loseContext();
    await lost;
    const restored = hear("webglcontextrestored");
    extension.restoreContext();
    await restored;
  });
  const changed = await changes(page, before, await steady(page, page.locator("#picture")));
  assert.ok(changed < 0.01, `${100 * changed} % of the restored picture differ`);
  // Single steps by keys: the G-code line follows.
  await page.keyboard.press("Home");
  assert.match(await text(page, "#where"), /^Move 0 of/);
  for (let step = 0; step < 5; step++) await page.keyboard.press("ArrowRight");
  assert.match(await text(page, "#where"), /^Move 5 of/);
  const line = await page.locator(".row.now i").innerText();
  assert.match(await text(page, ".row.now"), /G0[0-3]/);
  assert.match(await text(page, "#details"), /2050\.1P/);
  // A click on a line goes to its move; lines outside the window are rendered as the list is scrolled.
  for (let turn = 0; turn < 50 && (await page.locator(".row", { hasText: "G02" }).count()) === 0; turn++) {
    // Not by the wheel: Firefox would still scroll when the row is clicked.
    await page.locator("#code").evaluate((code) => (code.scrollTop += 100));
    await page.waitForTimeout(20);
  }
  await page.locator(".row", { hasText: "G02" }).first().click();
  assert.notEqual(await page.locator(".row.now i").innerText(), line);
  assert.match(await text(page, ".row.now"), /G02/);
  // The slider.
  await page.locator("#slider").fill(String(Math.floor(total / 2)));
  assert.match(await text(page, "#where"), new RegExp(`^Move ${Math.floor(total / 2)} of`));
  await page.keyboard.press("End");
  // A click on a move shows its line: look along the picture until there is one.
  await page.keyboard.press("Home");
  await page.keyboard.press("End");
  const box = await page.locator("#picture").boundingBox();
  let found = "";
  for (let x = box.x + 20; x < box.x + box.width - 20 && !/G-code/.test(found); x += 6) {
    await page.mouse.click(x, box.y + box.height * 0.45);
    found = await text(page, "#details");
  }
  assert.match(found, /G-code/);
  assert.match(await text(page, ".row.now"), /G0/);
  // Hovering describes the element.
  assert.match(found, /(LINE|CIRCLE|ARC) /);
  // Each parameter with its origin.
  assert.match(found, /\n[A-Z]\s+\S+ · (own text|first segment of the chain|text of the path|option --|default)/);
  await shot(page, "picked");
  // The height of the stock under the pointer, until the stock is hidden.
  const place = [box.x + box.width * 0.435, box.y + box.height * 0.568];
  await page.mouse.move(...place);
  await page.waitForFunction(() => document.getElementById("at").textContent.endsWith(" Z2.00"));
  await page.keyboard.press("s");
  await page.mouse.move(place[0] + 1, place[1]);
  await page.waitForFunction(() => !document.getElementById("at").textContent.includes("Z"));
  await page.keyboard.press("s");
  // Order numbers, rapids and arrows can be hidden.
  await page.keyboard.press("End");
  const numbers = await page.locator("#labels .order").count();
  assert.ok(numbers > 20, `${numbers} numbers`);
  await page.keyboard.press("n");
  assert.equal(await page.locator("#labels .order").count(), 0);
  await page.keyboard.press("n");
  await page.keyboard.press("r");
  assert.equal(await page.locator("#rapids").getAttribute("aria-pressed"), "false");
  // Measuring.
  await page.keyboard.press("m");
  await page.mouse.click(box.x + 100, box.y + 100);
  await page.mouse.click(box.x + 200, box.y + 100);
  assert.match(await text(page, "#measured"), /mm · ΔX/);
  await page.keyboard.press("Escape");
  assert.equal(await text(page, "#measured"), "");
  // The button says what it does.
  await page.locator("#play").click();
  assert.equal(await text(page, "#play"), "Stop");
  await page.locator("#play").click();
  assert.equal(await text(page, "#play"), "Run");
  // German, dark, in space.
  await page.keyboard.press("l");
  assert.match(await text(page, "#where"), /^Bewegung/);
  assert.equal(await text(page, "#rapids"), "Eilgänge");
  await page.keyboard.press("d");
  await page.keyboard.press("3");
  await page.waitForTimeout(200);
  assert.ok((await apart(page)) > 40);
  await shot(page, "dark-space");
  // Both choices survive a reload.
  await page.reload();
  await page.waitForSelector("html[data-ready]");
  assert.equal(await text(page, "#rapids"), "Eilgänge");
  assert.deepEqual(await page.evaluate(() => [document.documentElement.lang, document.documentElement.dataset.theme]), ["de", "dark"]);
  await page.keyboard.press("3");
  // On a picture as small as on a phone, where the legend is hidden, some labels have no room.
  await page.keyboard.press("g");
  await page.setViewportSize({ width: 390, height: 800 });
  const left = await apart(page);
  assert.ok(left > 5 && left < 60, `${left} labels`);
  assert.deepEqual(faults, []);
  await page.close();
}

{
  const { page, faults } = await open("mistakes/3001.1P.dxf", { viewport: { width: 390, height: 800 }, colorScheme: "dark" });
  assert.match(await text(page, "#findings"), /PB401/);
  assert.equal(await page.locator("#labels .finding").count(), 1);
  assert.match(await page.locator("#labels .finding").getAttribute("aria-label"), /^(finding|Befund) 1: PB401: /);
  await page.waitForTimeout(200);
  await shot(page, "mistake-390");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // A clamp is shown with its height.
  const { page, faults } = await open("mistakes/3011.1P.dxf");
  assert.equal(await text(page, "#labels .clamp"), "Z25");
  assert.match(await text(page, "#findings"), /PB407/);
  await page.keyboard.press("3");
  await page.waitForTimeout(200);
  await shot(page, "clamp");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // In space, numbers are at the upper face of the material, where cuts begin: on a plate without thickness they are elsewhere.
  const { page } = await open("8001.1P");
  const inSpace = async () => {
    const place = () => document.querySelector("#labels .order").style.transform;
    const fromAbove = await page.evaluate(place);
    await page.keyboard.press("3");
    await page.waitForFunction((fromAbove) => document.querySelector("#labels .order").style.transform !== fromAbove, fromAbove);
    return [fromAbove, await page.evaluate(place)];
  };
  const thick = await inSpace();
  const flat = join(directory, "flat.html");
  writeFileSync(flat, readFileSync(join(directory, "8001.1P.html"), "utf8").replaceAll(/("raised":[^,]*,"thickness":)[^,]*/g, "$10"));
  await page.goto(`file://${flat}`);
  await page.waitForSelector("html[data-ready]");
  const [fromAbove, there] = await inSpace();
  assert.equal(fromAbove, thick[0]);
  assert.notEqual(there, thick[1]);
  await page.close();
}
{
  // Fitting shows the whole stock, which a rapid move with a wide cutter enlarges: there is none at the edges of the picture.
  const program = ["G21 G90 G94 G17", "(T1 D=20. CR=0. - ZMIN=-1. - flat end mill)", "G00 X0 Y0 Z5", "G01 Z-1 F600", "G01 X20", "G00 Z-0.5", "G00 X60 Y20", "G00 Z5", "M30", ""];
  const file = join(directory, "wide.nc");
  writeFileSync(file, program.join("\n"));
  const { page, faults } = await open(file);
  const { x, y, width, height } = await page.locator("#picture").boundingBox();
  for (const [at, isStock] of [[[0.5, 0.5], true], [[0.005, 0.5], false], [[0.995, 0.5], false], [[0.5, 0.005], false], [[0.5, 0.995], false]]) {
    await page.mouse.move(x + width * at[0], y + height * at[1]);
    await page.waitForFunction((isStock) => /X/.test(document.getElementById("at").textContent) && /Z/.test(document.getElementById("at").textContent) === isStock, isStock);
  }
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // The animation: along a long move, the count of moves stays the same; at ten times the speed, the tool gets ten times as far.
  const program = ["G21 G90 G94 G17", "G00 X0 Y0 Z5", "G01 Z-1 F600", "G01 X2000 F600", "G01 Y50", "G00 Z5", "M30", ""];
  const file = join(directory, "by-time.gcode");
  writeFileSync(file, program.join("\n"));
  const { page, faults } = await open(file);
  assert.match(await text(page, "#clock"), /^4:48 elapsed · 0:00 remaining$/, "2056 mm by 10 mm/s, and 1.4 times as long");
  await page.locator("#assumedTool").fill("3");
  const way = async (speed) => {
    await page.locator("#speed").selectOption(speed);
    await page.locator("#slider").fill("2");
    const at = async () => Number(/X([\d.-]+)/.exec(await text(page, "#place"))[1]);
    const from = await at();
    const [begun] = [Date.now(), await page.locator("#play").click()];
    await page.waitForTimeout(600);
    await page.locator("#play").click();
    assert.match(await text(page, "#where"), /^Move 2 of/);
    return ((await at()) - from) / (Date.now() - begun);
  };
  // 600 mm/min are 10 mm/s, for which a machine takes 1.4 times as long.
  const [real, ten] = [await way("1"), await way("10")];
  assert.ok(real > 0.001 && real < 0.0072, `${real} mm/ms`);
  assert.ok(ten > 3 * real && ten < 0.072, `${ten} mm/ms`);
  assert.match(await text(page, "#pace"), /^F600 mm\/min$/);
  // The keys for speed, the list of keys.
  await page.locator("#picture").click({ position: { x: 5, y: 5 } });
  await page.keyboard.press("+");
  assert.equal(await page.locator("#speed").inputValue(), "100");
  await page.keyboard.press("-");
  await page.keyboard.press("-");
  assert.equal(await page.locator("#speed").inputValue(), "1");
  await page.keyboard.press("?");
  assert.ok(await page.locator("#help").isVisible());
  const listed = await text(page, "#key-list");
  const keys = [..."23FSRATNOGMLD?+", "PgUp", "Home", "Space", "→", "<"];
  assert.deepEqual(keys.filter((key) => !listed.includes(key)), []);
  await shot(page, "keys");
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#help").isHidden());
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // Drilled holes are visible although the cutter is unknown, and the time is given without that of rapid moves, whose speed is unknown.
  const file = join(directory, "holes.nc");
  const holes = [10, 20, 30].flatMap((x) => [`G0 X${x} Y5`, "G1 Z-2 F120", "G0 Z5"]);
  writeFileSync(file, ["G21 G90 G94 G17", "G0 Z5", "G0 X0 Y0", ...holes, "M30", ""].join("\n"));
  const { page, faults } = await open(file, {}, directory);
  assert.match(await text(page, "#details"), /time\s+1 min without rapid moves/);
  for (const key of ["r", "a", "g"]) await page.keyboard.press(key);
  const picture = (await steady(page, page.locator("#picture"))).toString("base64");
  const blue = await page.evaluate(async (picture) => {
    const image = Object.assign(new Image(), { src: `data:image/png;base64,${picture}` });
    await image.decode();
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const color = getComputedStyle(document.documentElement).getPropertyValue("--depth3");
    const parts = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
    let count = 0;
    for (let at = 0; at < data.length; at += 4) if (parts.every((part, index) => Math.abs(data[at + index] - part) < 4)) count++;
    return count;
  }, picture);
  assert.ok(blue > 80, `${blue} px of holes`);
  await shot(page, "holes");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // Operations: a click goes there and highlights the moves, and the highlighted row follows the tool.
  const { page, faults } = await open("8001.1P");
  await page.locator("#work summary").click();
  const rows = page.locator("#operations tr");
  const total = await rows.count();
  assert.ok(total > 10 && total < 100, `${total} operations`);
  await rows.nth(5).click();
  assert.equal(await rows.nth(5).getAttribute("aria-current"), "true");
  const there = await text(page, "#where");
  await shot(page, "operation");
  await page.keyboard.press(">");
  assert.equal(await rows.nth(6).getAttribute("aria-current"), "true");
  await page.keyboard.press("<");
  assert.equal(await text(page, "#where"), there);
  await page.keyboard.press("End");
  assert.equal(await page.locator("#operations [aria-current]").count(), 0);
  // Scales and colours are explained, until they are hidden.
  assert.match(await text(page, "#scale"), /^[125]0* mm$/);
  assert.match(await text(page, "#legend"), /Z-0.2[^]*cuts ahead[^]*outline of a part/);
  assert.doesNotMatch(await text(page, "#legend"), /rapid in material|cut into a part/);
  await page.keyboard.press("3");
  await page.waitForFunction(() => document.getElementById("scale").hidden);
  await page.keyboard.press("g");
  assert.ok(await page.locator("#legend").isHidden());
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // The legend names rapid moves in material from the first one that is shown.
  const file = join(directory, "rapid.nc");
  writeFileSync(file, ["G21 G90 G94 G17", "G0 Z5", "G0 X0 Y0", "G1 Z-2 F120", "G1 X20", "G0 X40", "G1 X60", "G0 Z5", "M30", ""].join("\n"));
  const { page, faults } = await open(file, {}, directory);
  await page.locator("#assumedTool").fill("3");
  assert.match(await text(page, "#legend"), /rapid in material/);
  await page.locator("#slider").fill("3");
  await page.locator("#assumedTool").fill("2");
  assert.doesNotMatch(await text(page, "#legend"), /rapid in material/);
  await page.locator("#slider").fill("6");
  assert.match(await text(page, "#legend"), /rapid in material/);
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // The height at the machine's own position is unknown: it is not shown, and moves there are no moves through material.
  const file = join(directory, "home.nc");
  writeFileSync(file, ["G21 G90 G94 G17", "G0 Z5", "G0 X0 Y0", "G1 Z-2 F120", "G1 X20", "G53 G0 Z0", "G0 X0 Y20", "G0 Z3", "G1 Z-1", "G0 Z5", "M30", ""].join("\n"));
  const { page, faults } = await open(file, {}, directory);
  const places = { 4: "X20.00 Y0.00 Z-2.00", 5: "X20.00 Y0.00", 6: "X0.00 Y20.00", 7: "X0.00 Y20.00 Z3.00" };
  for (const [move, place] of Object.entries(places)) {
    await page.locator("#slider").fill(move);
    assert.equal(await text(page, "#place"), place);
  }
  await page.locator("#assumedTool").fill("3");
  await page.locator("#assumedSurface").fill("1");
  await page.locator("#slider").fill("9");
  assert.doesNotMatch(await text(page, "#legend"), /rapid in material/);
  await page.locator("#view3").click();
  await shot(page, "home");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // A program is shown with its findings by line, the checks that were made or not, the cutter that it states, and its waits. Arcs count with their
  // lowest and outermost points.
  const file = join(directory, "checked.nc");
  const head = ["(T1 D=6 CR=0 - ZMIN=-6 - flat end mill)", "G21 G90 G94 G17 G54", "T1 M6", "M3 S9000", "G4 P2", "G0 Z5", "G0 X0 Y0"];
  writeFileSync(file, [...head, "G1 Z-1 F100", "G18 G2 X10 Z-1 I5 K0", "G0 Y20", "G17 G3 X10 Y20 I-10 J0", "G0 Z5", "M30", ""].join("\n"));
  const { page, faults } = await open(file, {}, directory);
  assert.match(await text(page, "#findings"), /line 10 · PB781/);
  assert.match(await text(page, "#checks"), /rapid moves: the height of the material is not known/);
  assert.match(await text(page, "#details"), /X -10 … 10, Y 0 … 30, Z -6 … 5[^]*cutter O\s+6[^]*2.0 s dwelling, 1 tool change/);
  await page.locator("#work summary").click();
  assert.match(await text(page, "#operations"), /-6/);
  assert.match(await text(page, "#legend"), /Z-6/);
  assert.ok(await page.locator("#typeTool").isHidden());
  assert.ok(await page.locator("#typeSurface").isVisible());
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // Everything that can be focused has a name, and every value has its own.
  const { page, faults } = await open("8001.1P");
  const nameless = await page.evaluate(() => {
    const nameOf = (node) => node.getAttribute("aria-label") || node.labels?.[0]?.textContent || node.textContent;
    return [...document.querySelectorAll("button, select, input, summary, dt, [tabindex], #picture")].filter((node) => node.offsetParent !== null && !nameOf(node).trim()).map((node) => node.id || node.outerHTML);
  });
  assert.deepEqual(nameless, []);
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // A picture that shows everything still does in a window of another size; one that was zoomed keeps its zoom.
  const { page, faults } = await open("8001.1P");
  const drawn = () => page.evaluate(() => [document.getElementById("scale").offsetWidth, document.querySelector("#labels .zero").style.transform].join());
  // A busy machine paints late: first the picture must change, and then it must remain as it is.
  const changedFrom = async (before) => {
    let [last, now] = [before, before];
    for (const end = Date.now() + 20_000; (now === before || now !== last) && Date.now() < end; ) {
      last = now;
      await page.waitForTimeout(300);
      now = await drawn();
    }
    return now;
  };
  const first = await drawn();
  await page.setViewportSize({ width: 640, height: 800 });
  const fitted = await changedFrom(first);
  assert.notEqual(fitted, first);
  await page.keyboard.press("f");
  await page.waitForTimeout(300);
  assert.equal(await drawn(), fitted);
  const box = await page.locator("#picture").boundingBox();
  await page.mouse.move(box.x + 50, box.y + 50);
  await page.mouse.wheel(0, -300);
  const zoomed = await changedFrom(fitted);
  await page.setViewportSize({ width: 1000, height: 700 });
  assert.equal((await changedFrom(zoomed)).split(",")[0], zoomed.split(",")[0]);
  assert.deepEqual(faults, []);
  await page.close();
}
if (!isFirefox) {
  // Playwright cannot have Firefox show a page as on paper.
  const { page, faults } = await open("8001.1P");
  // On paper, the picture keeps its size, for which the labels are placed, and the controls are left out.
  const placed = () => page.evaluate(() => [document.getElementById("picture").clientWidth, ...[...document.querySelectorAll("#labels .order")].map((node) => node.style.transform)].join());
  const before = await placed();
  await page.keyboard.press("d");
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  const ink = (name) => page.locator(name).evaluate((node) => getComputedStyle(node).color);
  assert.deepEqual([await ink("body"), await ink("#legend")], ["rgb(20, 32, 43)", "rgb(228, 235, 241)"], "light, and dark in the picture");
  await page.setViewportSize({ width: 1000, height: 1400 });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  assert.equal(await placed(), before);
  for (const id of ["play", "view3", "code"]) assert.ok(await page.locator(`#${id}`).isHidden(), id);
  assert.ok(await page.locator("#details").isVisible());
  await shot(page, "print");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // At a zoom of 200 %, the picture keeps its room, and the page scrolls to what is below.
  const { page, faults } = await open("8001.1P", { viewport: { width: 640, height: 400 } });
  const picture = await page.locator("#picture").boundingBox();
  assert.ok(picture.height > 200 && picture.y + picture.height <= (await page.locator("footer").boundingBox()).y + 1, JSON.stringify(picture));
  await page.locator("#details").scrollIntoViewIfNeeded();
  assert.ok(await page.evaluate(() => scrollY > 50));
  assert.ok((await page.locator("#play").boundingBox()).y < 400);
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // Of very many numbers, some are shown everywhere.
  const file = join(directory, "numbers.html");
  const html = readFileSync(join(directory, "8001.1P.html"), "utf8");
  const [begin, end] = [html.indexOf(">", html.indexOf('id="scene"')) + 1, html.indexOf("</script>", html.indexOf('id="scene"'))];
  const scene = JSON.parse(html.slice(begin, end));
  const numbered = scene.paths[0].elements.filter(({ order }) => order !== null);
  for (let order = 1000; order < 2000; order++) scene.paths[0].elements.push({ ...numbered[order % numbered.length], order });
  writeFileSync(file, html.slice(0, begin) + JSON.stringify(scene).replaceAll("<", "\\u003c") + html.slice(end));
  const page = await browser.newPage();
  await page.goto(`file://${file}`);
  await page.waitForSelector("html[data-ready]");
  const numbers = (await page.locator("#labels .order").allTextContents()).map(Number);
  assert.ok(numbers.length > 300 && numbers.length <= 600, `${numbers.length} numbers`);
  assert.ok(Math.min(...numbers) < 10 && Math.max(...numbers) > 1990, `${Math.min(...numbers)} to ${Math.max(...numbers)}`);
  await page.close();
}
{
  // Pending moves are faint: at the beginning there is more to see than the tool.
  const { page, faults } = await open("2051.1P");
  const ahead = () => steady(page, page.locator("#picture canvas").last());
  for (const key of ["s", "n", "t", "o", "g", "Home"]) await page.keyboard.press(key);
  await page.waitForTimeout(200);
  const first = await ahead();
  await page.keyboard.press("End");
  assert.ok(!first.equals(await ahead()));
  await page.keyboard.press("Home");
  assert.ok(first.equals(await ahead()));
  await shot(page, "ahead");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // On a phone, everything that can be tapped is as large as a finger.
  const { page, faults } = await open("8001.1P", { viewport: { width: 390, height: 800 }, hasTouch: true });
  await page.locator("#work summary").click();
  await page.waitForTimeout(100);
  const small = await page.evaluate(() => {
    const all = [...document.querySelectorAll("button, select, input, summary, #operations tr, .row")].filter((node) => node.offsetParent !== null);
    return all.map((node) => [node.id || node.className || node.tagName, node.getBoundingClientRect()]).filter(([, { width, height }]) => width < 44 || height < 44).map(([name, { width, height }]) => `${name} ${width}x${height}`);
  });
  assert.deepEqual(small, []);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await shot(page, "phone");
  assert.deepEqual(faults, []);
  await page.close();
}
if (!isFirefox) {
  // This many moves are kept as a picture, which is the same however a step is reached. In Firefox, this takes half a minute.
  const program = ["G21 G90 G94 G17", "G00 Z5", "G00 X0 Y0", "G01 Z-1 F100"];
  for (let move = 0; move < 30_000; move++) program.push(`G01 X${(Math.cos(move * 0.7) * (10 + move / 500)).toFixed(3)} Y${(Math.sin(move * 0.7) * (10 + move / 500)).toFixed(3)}`);
  const file = join(directory, "long.gcode");
  writeFileSync(file, [...program, "M30", ""].join("\n"));
  const { page, faults } = await open(file);
  const picture = async (...steps) => {
    for (const step of steps) {
      await page.locator("#slider").fill(String(step));
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    }
    return steady(page, page.locator("#picture"));
  };
  const [early, late] = [await picture(0, 12_345), await picture(23_456)];
  assert.ok(!early.equals(late));
  assert.ok(late.equals(await picture(30_000, 23_456)), "backwards");
  assert.ok(early.equals(await picture(12_345)), "far backwards");
  assert.ok(late.equals(await picture(...Array.from({ length: 10 }, (_, turn) => 14_456 + turn * 1000))), "by steps");
  // From another position it is different.
  await page.keyboard.press("3");
  const above = await picture(12_345);
  assert.ok(!above.equals(early));
  assert.ok(above.equals(await picture(23_456, 12_345)), "in space");
  await shot(page, "long");
  // The stock appears once the cutter's diameter is entered.
  assert.ok(await page.locator("#stock").isHidden());
  await page.locator("#assumedTool").fill("2");
  assert.ok(await page.locator("#stock").isVisible());
  await page.waitForTimeout(300);
  await shot(page, "long-stock");
  assert.deepEqual(faults, []);
  await page.close();
}
await browser.close();

{
  // Without WebGL there is a still picture, and everything else works.
  const still = await launchWithoutWebGL();
  const page = await still.newPage({ viewport: { width: 1280, height: 800 } });
  await page.goto(`file://${join(directory, "8001.1P.html")}`);
  await page.waitForSelector("html[data-ready]");
  assert.ok(await page.locator("#still svg").isVisible());
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowRight");
  assert.match(await text(page, "#where"), /^Move 1 of/);
  // The stock leaves the picture its half, and what needs WebGL is not offered.
  const [picture, drawn, stock] = await Promise.all(["#picture", "#still svg", "#flat"].map((name) => page.locator(name).boundingBox()));
  assert.ok(Math.abs(drawn.y - picture.y) < 1 && drawn.y + drawn.height < stock.y + 1, JSON.stringify([picture, drawn, stock]));
  assert.ok(stock.height > picture.height * 0.4 && stock.y + stock.height < picture.y + picture.height + 1);
  for (const id of ["view3", "rapids", "texts", "measure"]) assert.ok(await page.locator(`#${id}`).isHidden(), id);
  await shot(page, "still");
  await page.locator("#stock").click();
  assert.ok((await page.locator("#still svg").boundingBox()).width > 0.95 * picture.width);
  if (!isFirefox) {
    // Without scripts, which Playwright cannot disable in Firefox, the picture is all there is.
    const plain = await still.newPage({ javaScriptEnabled: false });
    await plain.goto(`file://${join(directory, "8001.1P.html")}`);
    assert.ok(await plain.locator("#still svg").isVisible());
    for (const name of ["aside", "#legend"]) assert.ok(await plain.locator(name).isHidden(), name);
  }
  await still.close();
}
rmSync(directory, { recursive: true });
console.log(`page${isFirefox ? ", in Firefox" : ""}: all passed`);
