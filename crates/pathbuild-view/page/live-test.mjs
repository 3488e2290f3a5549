// The page of a library that is watched, in a browser: node live-test.mjs PATHBUILD LIBRARY [PICTURES]; BROWSER=firefox tries
// Firefox.
import { copyFileSync, cpSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import assert from "node:assert/strict";
import { isFirefox, launch, launchWithoutWebGL } from "./browser.mjs";
import { serve } from "./serving.mjs";

const [pathbuild, library, pictures] = process.argv.slice(2).map((argument) => resolve(argument));
const place = join(mkdtempSync(join(tmpdir(), "pathbuild-live-")), "library");
cpSync(library, place, { recursive: true });
const directories = ["components", "mistakes", "projects"];

const browser = await launch();

/** Opens the page. Errors and requests to other servers fail the test. */
async function open(address, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, locale: "en", ...options });
  const faults = [];
  // Firefox takes screenshots by means of a style element, which the page's policy refuses.
  const isOfPicture = (fault) => isFirefox && pictures && fault.includes("blocked an inline style");
  const note = (fault) => isOfPicture(fault) || faults.push(fault);
  page.on("pageerror", (error) => note(String(error)));
  page.on("console", (message) => message.type() === "error" && note(message.text()));
  page.on("request", (request) => request.url().startsWith(new URL("/", address).href) || /^(data|blob):/.test(request.url()) || faults.push(request.url()));
  await page.goto(address);
  await page.waitForSelector(".item");
  return { page, faults };
}

async function shot(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}${isFirefox ? "-firefox" : ""}.png`) });
}

const text = (page, selector) => page.locator(selector).innerText();
const camera = (page) => page.locator("#labels .zero").first().evaluate((node) => node.style.transform);
const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** Saves a drawing atomically, as careful programs do. */
function save(name, change) {
  const file = join(place, name);
  writeFileSync(`${file}.new`, change(readFileSync(file, "latin1")), "latin1");
  renameSync(`${file}.new`, file);
}

const { server, address } = await serve(pathbuild, place, "127.0.0.1:0", ...directories);
{
  const { page, faults } = await open(address);
  // The library: rows with their states, and the counts.
  await page.waitForFunction(() => /paths$/.test(document.getElementById("count").textContent));
  const all = Number(/^(\d+) paths/.exec(await text(page, "#count"))[1]);
  assert.ok(all > 20, `${all} paths`);
  assert.match(await text(page, "#states"), /errors \d+/);
  await shot(page, "live-library");
  await page.click("#totals");
  assert.match(await text(page, "#statistics"), /cutter O/);
  await shot(page, "live-statistics");
  await page.click("#totals");
  // By state.
  await page.click("#filter-errors");
  const wrong = Number(/^(\d+) of/.exec(await text(page, "#count"))[1]);
  assert.ok(wrong > 0 && wrong < all, `${wrong} of ${all}`);
  assert.equal(await page.locator(".item .state.ok").count(), 0);
  await page.click("#filter-all");
  // Search with keys only: the picture of a path opens.
  await page.keyboard.press("/");
  await page.keyboard.type("8001.1p");
  assert.equal(await page.locator(".item").count(), 1);
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.getElementById("title").textContent === "8001.1P");
  assert.match(await text(page, "#where"), /^Move \d+ of \d+/);
  assert.match(page.url(), /#file=.*path=8001\.1P/);
  await settled(page);
  await shot(page, "live-path");
  // After Enter in the search, the keys of the picture work.
  await page.keyboard.press("/");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Home");
  assert.match(await text(page, "#where"), /^Move 0 of/);
  assert.equal(await page.inputValue("#search"), "8001.1p");
  // Reloading shows the same.
  await page.reload();
  await page.waitForFunction(() => document.getElementById("title").textContent === "8001.1P");
  // Language, colours.
  await page.keyboard.press("l");
  assert.match(await text(page, "#where"), /^Bewegung/);
  assert.match(await text(page, "#count"), /Pfade$/);
  assert.match(await text(page, "#states"), /Fehler/);
  await page.keyboard.press("d");
  await settled(page);
  await shot(page, "live-german-other-colours");
  await page.keyboard.press("l");
  await page.keyboard.press("d");
  // Back to the library, and back to the path.
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#viewer").isHidden());
  await page.goBack();
  await page.waitForSelector("#viewer:not([hidden])");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  const file = "mistakes/3001.1P.dxf";
  const { page, faults } = await open(`${address}#${new URLSearchParams({ file, path: "3001.1P" })}`);
  await page.waitForFunction(() => /PB401/.test(document.getElementById("findings").textContent));
  // A click on a finding goes to its place.
  const before = await camera(page);
  await page.locator("#findings button").first().click();
  await settled(page);
  const near = await camera(page);
  assert.notEqual(near, before);
  const circle = await page.locator("#labels .finding").first().boundingBox();
  const box = await page.locator("#picture").boundingBox();
  assert.ok(Math.hypot(circle.x + circle.width / 2 - box.x - box.width / 2, circle.y + circle.height / 2 - box.y - box.height / 2) < 20, JSON.stringify(circle));
  await shot(page, "live-mistake");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // The row of the open path is visible as a whole, though the list becomes narrower.
  const { page, faults } = await open(`${address}#${new URLSearchParams({ file: "mistakes/3011.1P.dxf", path: "3011.1P" })}`);
  await page.waitForFunction(() => /paths$/.test(document.getElementById("count").textContent) && document.getElementById("title").textContent === "3011.1P");
  await settled(page);
  const [row, list] = [await page.locator(".item[aria-selected=true]").boundingBox(), await page.locator("#list").boundingBox()];
  assert.ok(row.y + row.height <= list.y + list.height + 1, JSON.stringify([row, list]));
  // The counts of the states are those of the rows, among which are drawings that cannot be read.
  const number = async (id) => Number(/ (\d+)$/.exec(await text(page, id))[1]);
  const before = await number("#filter-errors");
  writeFileSync(join(place, "mistakes", "4000.1P.dxf"), "0\nSECTION\n2\nENTITIES\n");
  await page.waitForFunction((before) => document.getElementById("filter-errors").textContent.endsWith(` ${before + 1}`), before);
  assert.equal(await number("#filter-all"), Number(/^(\d+) paths/.exec(await text(page, "#count"))[1]));
  // Such a drawing stays selected once its paths can be read.
  await page.locator(".item", { hasText: "4000.1P.dxf" }).click();
  await page.waitForFunction(() => /PB002/.test(document.getElementById("findings").textContent));
  const mended = readFileSync(join(place, "components", "2069.1P.dxf"), "latin1").replaceAll("2069.1P", "4000.1P");
  writeFileSync(join(place, "mistakes", "4000.1P.new"), mended, "latin1");
  renameSync(join(place, "mistakes", "4000.1P.new"), join(place, "mistakes", "4000.1P.dxf"));
  await page.waitForFunction(() => Number(document.getElementById("slider").max) > 0);
  assert.match(await text(page, ".item[aria-selected=true]"), /4000\.1P.dxf/);
  await page.waitForFunction((before) => document.getElementById("filter-errors").textContent.endsWith(` ${before}`), before);
  // A press opens its row, though the list changes before the release.
  await page.locator(".item", { hasText: "3001.1P.dxf" }).hover();
  await page.mouse.down();
  rmSync(join(place, "mistakes", "4000.1P.dxf"));
  await page.locator(".item", { hasText: "4000.1P.dxf" }).waitFor({ state: "detached" });
  await page.mouse.up();
  await page.waitForFunction(() => document.getElementById("title").textContent === "3001.1P");
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // A program opened here is checked by the server of the page, with the values of pathbuild.toml.
  const { page, faults } = await open(address);
  const file = join(place, "..", "slot.nc");
  writeFileSync(file, "(TOOL/MILL, 6, 0, 20, 0)\nG21 G90 G94 G17\nG0 Z5\nG0 X0 Y0\nG1 Z-2 F100\nG1 X20\nG0 X40\nG1 X60\nG0 Z5\nM30\n");
  await page.setInputFiles("#programs", file);
  await page.waitForFunction(() => document.getElementById("title").textContent === "slot.nc");
  assert.match(await text(page, "#findings"), /line 7 · PB781/);
  await page.locator("#assumedSurface").fill("0");
  await page.locator("#assumedSurface").press("Tab");
  await page.waitForFunction(() => /PB740/.test(document.getElementById("findings").textContent));
  assert.match(page.url(), /#program&surface=0$/);
  assert.match(await text(page, "#checks"), /6 mm \(header\)/);
  await settled(page);
  await shot(page, "live-program");
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#viewer").isHidden());
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // A saved drawing appears; camera, layers and selection are kept.
  const file = "components/2054.1P.dxf";
  const { page, faults } = await open(`${address}#${new URLSearchParams({ file, path: "2054.1P" })}`);
  await page.waitForFunction(() => document.getElementById("title").textContent === "2054.1P");
  await page.keyboard.press("a");
  await page.keyboard.press("Home");
  for (let step = 0; step < 3; step++) await page.keyboard.press("ArrowRight");
  const picture = page.locator("#picture");
  const box = await picture.boundingBox();
  await page.mouse.move(box.x + box.width / 3, box.y + box.height / 3);
  await page.mouse.wheel(0, -300);
  await page.waitForTimeout(300);
  const view = await camera(page);
  const chosen = await text(page, "#details");
  assert.match(chosen, /LINE|CIRCLE|ARC/);
  const moves = await page.locator("#slider").getAttribute("max");
  const begun = Date.now();
  save(file, (drawing) => drawing.replace("I0.5", "I0.25"));
  await page.waitForFunction((moves) => Number(document.getElementById("slider").max) > Number(moves), moves);
  await settled(page);
  console.log(`edit to picture: ${Date.now() - begun} ms`);
  assert.equal(await camera(page), view);
  assert.equal(await page.locator("#arrows").getAttribute("aria-pressed"), "false");
  assert.match(await text(page, "#where"), /^Move 3 of/);
  assert.equal((await text(page, "#details")).split("\n")[0], chosen.split("\n")[0]);
  // The same move stays selected if the CAD program gives each handle to another element.
  const renumbered = (by) => (drawing) => drawing.replace(/(\r\n  5\r\n)([0-9A-F]+)/g, (_, code, handle) => code + (parseInt(handle, 16) + by).toString(16).toUpperCase());
  const handle = async () => /[A-Z]+ ([0-9A-F]+) ·/.exec(await text(page, "#details"))[1];
  const before = await handle();
  const next = (parseInt(before, 16) + 1).toString(16).toUpperCase();
  save(file, renumbered(1));
  await page.waitForFunction((next) => document.getElementById("details").textContent.includes(` ${next} ·`), next);
  assert.match(await text(page, "#where"), /^Move 3 of/);
  save(file, renumbered(-1));
  await page.waitForFunction((before) => document.getElementById("details").textContent.includes(` ${before} ·`), before);
  // The current move stays the same one after a version with errors, and so do the facts about it.
  const has = ([least, most]) => page.waitForFunction(([least, most]) => ((all) => all >= least && all <= most)(Number(document.getElementById("slider").max)), [least, most]);
  save(file, (drawing) => drawing.replace("I0.25", "I0.5"));
  await has([Number(moves), Number(moves)]);
  await page.keyboard.press("End");
  for (let step = 0; step < 4; step++) await page.keyboard.press("ArrowLeft");
  const current = Number(moves) - 4;
  assert.match(await text(page, "#where"), new RegExp(`^Move ${current} of`));
  save(file, (drawing) => drawing.replace("I0.5", "I0,,5"));
  await has([0, 0]);
  save(file, (drawing) => drawing.replace("I0,,5", "I0.25"));
  await has([Number(moves) + 1, 1e9]);
  const [, number, all] = /^Move (\d+) of (\d+)/.exec(await text(page, "#where"));
  assert.ok(Number(number) < Number(all), `move ${number} of ${all}`);
  assert.match(await text(page, "#details"), new RegExp(`^move\\s+${number}:`, "i"));
  // The removal of a drawing is reported, and the last picture stays; when it returns, it appears.
  renameSync(join(place, file), join(place, "gone.kept"));
  await page.waitForSelector("#note:not([hidden])");
  assert.match(await text(page, "#note"), /no longer there/);
  renameSync(join(place, "gone.kept"), join(place, file));
  await page.waitForSelector("#note", { state: "hidden" });
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // The address of a missing path leads to the list, and not to the path that was open before.
  const { page } = await open(`${address}#${new URLSearchParams({ file: "components/2054.1P.dxf", path: "2054.1P" })}`);
  await page.waitForFunction(() => document.getElementById("title").textContent === "2054.1P");
  await page.evaluate((hash) => (location.hash = hash), new URLSearchParams({ file: "components/2054.1P.dxf", path: "2054.9P" }).toString());
  await page.waitForSelector("#trouble:not([hidden])");
  assert.match(await text(page, "#trouble"), /^2054\.9P components\/2054\.1P\.dxf is not there/);
  assert.ok(await page.locator("#viewer").isHidden());
  await page.close();
}
{
  // On a phone.
  const { page, faults } = await open(address, { viewport: { width: 390, height: 800 }, colorScheme: "dark", locale: "de" });
  await shot(page, "live-library-390");
  await page.fill("#search", "8001.1P");
  await page.locator(".item").first().click();
  await page.waitForFunction(() => document.getElementById("title").textContent === "8001.1P");
  await settled(page);
  await shot(page, "live-path-390");
  assert.ok(await page.locator("#library").isHidden());
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.click("#back");
  assert.ok(await page.locator("#library").isVisible());
  assert.deepEqual(faults, []);
  await page.close();
}
{
  // Without WebGL there is a still picture, as an image: no content of a drawing becomes part of the page.
  const still = await launchWithoutWebGL();
  const page = await still.newPage({ viewport: { width: 1280, height: 800 } });
  await page.goto(`${address}#${new URLSearchParams({ file: "projects/8001.1P.dxf", path: "8001.1P" })}`);
  await page.waitForFunction(() => document.querySelector("#still img")?.naturalWidth > 100);
  assert.ok(await page.locator("#still img").isVisible());
  await shot(page, "live-still");
  await still.close();
}
{
  // Texts of drawings are shown as text, even if they look like markup.
  const hostile = `evil <img src=x onerror=alert(1)> & "q".dxf`;
  copyFileSync(join(place, "mistakes/3001.1P.dxf"), join(place, "mistakes", hostile));
  const { page, faults } = await open(address);
  await page.fill("#search", "onerror");
  await page.waitForFunction(() => document.querySelectorAll(".item").length === 1);
  assert.match(await text(page, ".item .file"), /<img src=x onerror=alert\(1\)>/);
  await page.locator(".item").click();
  await page.waitForSelector("#viewer:not([hidden])");
  assert.equal(await page.locator("#library img, #viewer img").count(), 0);
  // When pathbuild ends, the page says so.
  faults.splice(0).forEach((fault) => assert.fail(fault));
  server.kill("SIGINT");
  await page.waitForSelector("#note:not([hidden])");
  assert.match(await text(page, "#note"), /No connection/);
  await settled(page);
  await shot(page, "live-offline");
  await page.close();
}
{
  // From another machine: the token is removed from the address and survives reloading; without it, the server answers nothing.
  const { server, address } = await serve(pathbuild, place, "0.0.0.0:0", ...directories);
  const { page, faults } = await open(address);
  assert.ok(!page.url().includes("token"), page.url());
  await page.reload();
  await page.waitForSelector(".item");
  assert.deepEqual(faults, []);
  await page.close();
  const stranger = await browser.newPage();
  await stranger.goto(address.split("#")[0]);
  await stranger.waitForSelector("#trouble:not([hidden])");
  assert.match(await text(stranger, "#trouble"), /complete address/);
  assert.equal(await stranger.locator(".item").count(), 0);
  await stranger.close();
  server.kill();
}
await browser.close();
rmSync(join(place, ".."), { recursive: true });
console.log(`live page${isFirefox ? ", in Firefox" : ""}: all passed`);
