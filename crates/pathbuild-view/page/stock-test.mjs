// Tests the heights of the stock without a browser: node stock-test.mjs PATHBUILD LIBRARY.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import assert from "node:assert/strict";
import { build } from "esbuild";

const [pathbuild, library] = process.argv.slice(2).map((argument) => resolve(argument));
const directory = mkdtempSync(join(tmpdir(), "pathbuild-stock-"));
await build({ entryPoints: ["src/stock/stock.ts"], bundle: true, format: "esm", outfile: join(directory, "stock.mjs"), logLevel: "error" });
const { Stock } = await import(join(directory, "stock.mjs"));
const given = { tool: null, thickness: null, surface: null };
const paints = { uncut: [219, 189, 133], shallow: [189, 148, 92], deep: [115, 77, 41], plate: [204, 214, 224], wrong: [229, 13, 26], leftover: [150, 40, 200], loose: [230, 159, 0] };
const stockOf = (scene, assumed = given) => Stock.of(scene, assumed, paints);

function sceneOf(path) {
  const file = join(directory, "scene.json");
  execFileSync(pathbuild, ["view", path, "-o", file], { cwd: library, stdio: "pipe" });
  return JSON.parse(readFileSync(file, "utf8"));
}

/** Pseudorandom numbers from 0 to 1, the same in every run. */
let seed = 12345;
const random = () => (seed = (seed * 1103515245 + 12345) & 0x7fffffff) / 0x7fffffff;

/** The moves that may reach a point or a neighbour of it, each with its path. */
function movesNear({ paths }, [x, y]) {
  const found = [];
  for (const path of paths) {
    const [px, py] = [x - path.zero[0], y - path.zero[1]];
    for (const move of path.moves) {
      const { kind, from, to, arc } = move;
      if (kind === "probe" || [from[0], from[1], to[0], to[1]].includes(null)) continue;
      const reach = path.tool / 2 + 0.02 + (arc ? 2 * Math.hypot(from[0] - arc.centre[0], from[1] - arc.centre[1]) : 0);
      const isNear = (at, a, b) => at > Math.min(a, b) - reach && at < Math.max(a, b) + reach;
      if (isNear(px, from[0], to[0]) && isNear(py, from[1], to[1])) found.push({ path, move });
    }
  }
  return found;
}

/** The exact height at a point, from the true shape of each move. */
function exact(moves, top, [x, y]) {
  let height = top;
  for (const { path, move } of moves) {
    const { kind, from, to, arc } = move;
    const r = path.tool / 2;
    const raise = kind === "sweep" || kind === "lift" ? 0.002 : 0;
    const [a, b] = [from[2] ?? to[2] ?? 0, to[2] ?? from[2] ?? 0];
    if (Math.min(a, b) >= height) continue;
    const [px, py] = [x - path.zero[0], y - path.zero[1]];
    // The stretch of the move, from 0 to 1, from which the cutter reaches the point.
    for (const [begin, end] of arc ? stretchesOfArc(from, arc, px, py, r) : stretchOfLine(from, to, px, py, r)) {
      height = Math.min(height, a + (b - a) * begin + raise, a + (b - a) * end + raise);
    }
  }
  return height;
}

function stretchOfLine(from, to, x, y, r) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  if (length < 1e-9) return Math.hypot(x - from[0], y - from[1]) <= r ? [[0, 1]] : [];
  const along = ((x - from[0]) * dx + (y - from[1]) * dy) / length;
  const beside = ((y - from[1]) * dx - (x - from[0]) * dy) / length;
  if (Math.abs(beside) > r) return [];
  const half = Math.sqrt(r * r - beside * beside);
  const [begin, end] = [Math.max(along - half, 0) / length, Math.min(along + half, length) / length];
  return begin <= end ? [[begin, end]] : [];
}

function stretchesOfArc(from, { axes, centre, clockwise, degrees }, x, y, r) {
  assert.deepEqual(axes, [0, 1], "arcs lie in the plane");
  const radius = Math.hypot(from[0] - centre[0], from[1] - centre[1]);
  const away = Math.hypot(x - centre[0], y - centre[1]);
  if (away > radius + r || away < radius - r) return [];
  const sweep = (degrees * Math.PI) / 180;
  const cosine = away === 0 ? -1 : (away * away + radius * radius - r * r) / (2 * away * radius);
  const half = cosine <= -1 ? Math.PI : Math.acos(Math.min(1, cosine));
  const angle = Math.atan2(y - centre[1], x - centre[0]) - Math.atan2(from[1] - centre[1], from[0] - centre[0]);
  const turned = (clockwise ? -1 : 1) * angle;
  const middle = turned - 2 * Math.PI * Math.floor(turned / (2 * Math.PI));
  return [-1, 0, 1]
    .map((turn) => [Math.max(middle + turn * 2 * Math.PI - half, 0) / sweep, Math.min(middle + turn * 2 * Math.PI + half, sweep) / sweep])
    .filter(([begin, end]) => begin <= end);
}

/** A move in the form of a scene. */
const move = (kind, from, to) => ({ kind, from, to, length: 0 });
const plain = (tool, thickness, moves) => ({ through: 0.001001, paths: [{ tool, thickness, zero: [0, 0], embedded: [], elements: [], moves }], findings: [] });

{
  // Texel centres, since only their heights are known.
  const around = Array.from({ length: 64 }, (_, turn) => [turn % 2 ? 0.01 : 0.005, (turn * Math.PI) / 32]);
  const beside = around.map(([away, angle]) => [away * Math.cos(angle), away * Math.sin(angle)]);
  const lines = execFileSync(pathbuild, ["list", "--format", "json"], { cwd: library, encoding: "utf8" }).trim().split("\n");
  const paths = lines.map((line) => JSON.parse(line)).filter(({ type, path }) => type === "path" && path.endsWith("P"));
  let [programs, worst] = [0, 0];
  for (const { path: name } of paths) {
    const scene = sceneOf(name);
    const stock = stockOf(scene);
    assert.ok(stock, name);
    stock.seek(stock.map.cutting.until.length);
    const { columns, rows, texel, heights, tops, cutting } = stock.map;
    for (let turn = 0; turn < 1000; turn++) {
      const [column, row] = [Math.floor(random() * columns), Math.floor(random() * rows)];
      const [x, y] = [cutting.box[0] + (column + 0.5) * texel, cutting.box[1] + (row + 0.5) * texel];
      const [height, top] = [heights[row * columns + column], tops[row * columns + column]];
      const moves = movesNear(scene, [x, y]);
      // Beside a wall the height lies between those on either side of it.
      let heightsThere = [exact(moves, top, [x, y])];
      const differs = () => Math.max(Math.min(...heightsThere) - height, height - Math.max(...heightsThere), 0);
      if (differs() > 0.01) heightsThere = beside.map(([dx, dy]) => exact(moves, top, [x + dx, y + dy]));
      assert.ok(differs() <= 0.01, `${name} at ${x} ${y}: ${height} differs by ${differs()}`);
      worst = Math.max(worst, differs());
    }
    programs++;
  }
  assert.ok(programs >= 30, `${programs} programs`);
  console.log(`heights: 1000 points of each of ${programs} programs, worst ${worst.toFixed(5)} mm`);
}

{
  // Jumps back and forth give the same heights and colours as new maps.
  const scene = sceneOf("8001.1P");
  const stock = stockOf(scene);
  const total = stock.map.cutting.until.length;
  for (let jump = 0; jump < 60; jump++) {
    const to = Math.floor(random() * (total + 1));
    stock.seek(to);
    const fresh = stockOf(scene);
    fresh.seek(to);
    assert.ok(Buffer.from(stock.colors.buffer).equals(Buffer.from(fresh.colors.buffer)), `jump ${jump} to move ${to}`);
    assert.ok(Buffer.from(stock.map.heights.buffer).equals(Buffer.from(fresh.map.heights.buffer)), `heights after jump ${jump}`);
  }
  // A partially cut move leaves no trace once the tool is elsewhere.
  for (let jump = 0; jump < 60; jump++) {
    stock.seek(Math.floor(random() * total), random());
    const to = Math.floor(random() * (total + 1));
    stock.seek(to);
    const fresh = stockOf(scene);
    fresh.seek(to);
    assert.ok(Buffer.from(stock.colors.buffer).equals(Buffer.from(fresh.colors.buffer)), `after a share, jump ${jump} to move ${to}`);
  }
  console.log("60 jumps: each as a fresh map");
}

{
  // A bar 3 mm long between two cuts of a cutter of 2 mm, whose centres are 5 mm apart.
  const z = -0.2;
  const scene = plain(2, 2, [move("plunge", [0, 0, 5], [0, 0, z]), move("mill", [0, 0, z], [20, 0, z]), move("mill", [20, 0, z], [20, 0, 1]), move("mill", [20, 0, 1], [25, 0, 1]), move("mill", [25, 0, 1], [25, 0, z]), move("mill", [25, 0, z], [45, 0, z])]);
  const stock = stockOf(scene);
  stock.seek(6);
  const { texel } = stock.map;
  let wide = 0;
  for (let x = 15; x < 30; x += texel) if (stock.map.at(x, 0) > 0.9) wide += texel;
  assert.ok(Math.abs(wide - 3) <= 2 * texel, `the bar is ${wide} mm wide`);
  assert.ok(stock.map.rapid.every((it) => it === 0), "no rapid move cuts");
  console.log(`bar: ${wide.toFixed(3)} mm of 3 mm, texels of ${texel.toFixed(3)} mm`);
}

{
  // Half of a move cuts half of its length.
  const stock = stockOf(plain(2, 2, [move("mill", [0, 0, 0], [20, 0, 0]), move("mill", [20, 0, 0], [20, 20, 0])]));
  stock.seek(1, 0.5);
  assert.deepEqual([[20, 9], [20, 12], [10, 0]].map((at) => stock.map.at(...at)), [0, 2, 0]);
  stock.seek(0, 0.25);
  assert.deepEqual([[20, 9], [4, 0], [8, 0]].map((at) => stock.map.at(...at)), [2, 0, 2]);
}

{
  // A rapid move through material is marked; along the floor of a cut it is not.
  const cut = [move("plunge", [0, 0, 5], [0, 0, -1]), move("mill", [0, 0, -1], [20, 0, -1])];
  const marks = (scene) => {
    const stock = stockOf(scene);
    stock.seek(scene.paths[0].moves.length);
    return stock.map.rapid.reduce((sum, it) => sum + (it ? 1 : 0), 0);
  };
  assert.equal(marks(plain(2, null, [...cut, move("sweep", [20, 0, -1], [0, 0, -1])])), 0);
  assert.ok(marks(plain(2, null, [...cut, move("sweep", [20, 0, -1], [20, 1, -1])])) > 0);
  assert.equal(stockOf(plain(null, 2, cut)), null, "without a cutter there is no stock");
  const faces = (is_on_zero, surface) => {
    const [blank] = stockOf({ ...plain(null, null, cut), program: { is_on_zero } }, { tool: 2, thickness: 3, surface }).map.cutting.blanks;
    return [blank.top, Number(blank.through.toFixed(3))];
  };
  assert.deepEqual(faces(true, null), [3, 0.001], "material on Z 0 has the thickness that is typed");
  assert.deepEqual(faces(false, null), [0, -2.999], "elsewhere, Z 0 is its upper face");
  assert.deepEqual(faces(false, 1), [1, -1.999], "the surface is where it is typed");
}

{
  // A rapid move below the upper face is marked far from all cuts as well; one above it does not enlarge the stock.
  const far = (z) => {
    const stock = stockOf(plain(2, 2, [move("plunge", [0, 0, 5], [0, 0, 1]), move("mill", [0, 0, 1], [20, 0, 1]), move("sweep", [40, 20, z], [60, 20, z])]));
    stock.seek(3);
    return [stock.map.at(50, 20), stock.map.hasRapidCut];
  };
  assert.ok(Math.abs(far(1)[0] - 1.002) < 1e-6 && far(1)[1], "a rapid move far away");
  assert.deepEqual(far(2), [-1e9, false], "on the upper face");
}

{
  // Ball and bull nose leave a round bottom, also along slopes; of an unknown shape there is a flat bottom, and the legend says so.
  const exactHeight = ([from, to], round, radius, [x, y]) => {
    let height = Infinity;
    for (let step = 0; step <= 20_000; step++) {
      const at = [0, 1, 2].map((axis) => from[axis] + ((to[axis] - from[axis]) * step) / 20_000);
      const outside = Math.hypot(x - at[0], y - at[1]) - (radius - round);
      if (outside <= round) height = Math.min(height, at[2] + round - Math.sqrt(round * round - Math.max(outside, 0) ** 2));
    }
    return height;
  };
  let worst = 0;
  for (const round of [1.5, 0.5]) {
    for (const ends of [[[0, 0, 1], [20, 0, 1]], [[0, 0, 1], [20, 0, 3]], [[2, 10, 4], [8, 0, 1]], [[0, 0, 4], [2, 0, 1]]]) {
      const scene = plain(3, 5, [move("mill", ...ends)]);
      scene.paths[0].tip = { round };
      const stock = stockOf(scene);
      stock.seek(1);
      const { columns, rows, texel, cutting } = stock.map;
      for (let turn = 0; turn < 200; turn++) {
        const at = [Math.floor(random() * columns), Math.floor(random() * rows)].map((index, axis) => cutting.box[axis] + (index + 0.5) * texel);
        const expected = Math.min(5, exactHeight(ends, round, 1.5, at));
        const differs = Math.abs(stock.map.at(...at) - expected);
        // On the rim, walls are vertical.
        const isRim = expected > 5 - 1e-9 || Math.abs(Math.min(...[-0.01, 0.01].flatMap((d) => [exactHeight(ends, round, 1.5, [at[0] + d, at[1]]), exactHeight(ends, round, 1.5, [at[0], at[1] + d])])) - expected) > 0.05;
        if (!isRim) worst = Math.max(worst, differs);
      }
    }
  }
  assert.ok(worst <= 0.01, `round bottoms differ by ${worst}`);
  const cut = plain(3, 5, [move("mill", [0, 0, 1], [20, 0, 1])]);
  assert.equal(stockOf(cut).map.cutting.hasUnknownTip, false);
  cut.paths[0].tip = "unknown";
  const stock = stockOf(cut);
  stock.seek(1);
  assert.deepEqual([stock.map.cutting.hasUnknownTip, stock.map.at(10, 1.4)], [true, 1]);
  console.log(`round bottoms: worst ${worst.toFixed(5)} mm`);
}

{
  // A cut goes through at the plate or below: not if Z0 is the upper face, and for a raised component where that lies.
  const cut = (z) => [move("plunge", [0, 0, 9], [0, 0, z]), move("mill", [0, 0, z], [20, 0, z])];
  const isThrough = (scene) => {
    const stock = stockOf(scene);
    stock.seek(scene.paths[0].moves.length);
    const { columns, rows, heights, through } = stock.map;
    const middle = (rows >> 1) * columns + (columns >> 1);
    return heights[middle] <= through[middle];
  };
  assert.ok(isThrough(plain(2, 2, cut(0.001))));
  assert.ok(!isThrough(plain(2, 2, cut(0.0011))));
  assert.ok(!isThrough(plain(2, 0, cut(-1))));
  const raised = (z) => {
    const scene = plain(2, 2, cut(z).map((it) => ({ ...it, element: 0 })));
    Object.assign(scene.paths[0], { embedded: [{ thickness: 2, raised: 0 }, { thickness: 7, raised: 5 }], elements: [{ path: 1 }] });
    return scene;
  };
  assert.ok(isThrough(raised(5.001)));
  assert.ok(!isThrough(raised(5.0011)));
}

{
  // The regions of findings are coloured, and nothing else: a cut into a part, a bar that is cut away, and material that is left. An
  // opening that is cut by its inner ring is as drawn.
  const line = (from, to) => ({ type: "line", from, to });
  const ring = ([x0, y0], [x1, y1]) => [line([x0, y0], [x1, y0]), line([x1, y0], [x1, y1]), line([x1, y1], [x0, y1]), line([x0, y1], [x0, y0])];
  const rings = [ring([0, 0], [40, 20]), ring([10, 6], [18, 14]), ring([11, 7], [17, 13])];
  const findings = { left: [{ outline: [line([40, 20], [0, 20])], reach: 0.5 }], gouges: [line([41, -0.5], [-1, -0.5])], lost_bars: [line([-1, 4], [-1, 7])] };
  const along = (...points) => points.slice(1).map((to, index) => move("mill", [...points[index], 0], [...to, 0]));
  const scene = plain(2, 2, [...along([-1, -1], [-1, 21.5], [41, 21.5], [41, -0.5], [-1, -0.5]), ...along([11, 7], [17, 7], [17, 13], [11, 13], [11, 7])]);
  /** Areas of the colours of findings in mm², where these regions may be. */
  const colored = (findings) => {
    scene.paths[0].parts = [{ rings, top: 2, left: [], ...findings }];
    const stock = stockOf(scene);
    const { columns, texel, cutting, through, heights } = stock.map;
    const [counts, wrong] = [{ cut: 0, left: 0, loose: 0 }, []];
    const begun = stock.colors.slice();
    stock.seek(scene.paths[0].moves.length);
    for (let at = 0; at < heights.length; at++) {
      const [x, y] = [cutting.box[0] + ((at % columns) + 0.5) * texel, cutting.box[1] + (Math.floor(at / columns) + 0.5) * texel];
      const is = (colors) => {
        const [red, green, blue] = colors.subarray(at * 4, at * 4 + 3);
        return red > 150 && green < 80 && blue < 90 ? "cut" : blue > 140 && green < 90 ? "left" : blue < 0.42 * red ? "loose" : null;
      };
      assert.notEqual(is(begun), "cut", "before anything is cut");
      const what = is(stock.colors);
      // The dark side of a wall may look like anything.
      if (!what || (what === "loose" && !findings.is_loose)) continue;
      counts[what] += texel * texel;
      const isInside = x > 0 && x < 40 && y > 0 && y < 20;
      const isCut = heights[at] <= through[at] && ((isInside && y < 0.5 + texel) || (x > -2 - texel && x < texel && y > 4 - texel && y < 7 + texel));
      const isRight = { cut: isCut, left: (y > 20 && y < 20.5 + texel) || Math.hypot(x - 18, y - 14) < 1 + texel, loose: isInside && heights[at] > through[at] }[what];
      if (!isRight) wrong.push([what, x, y]);
    }
    assert.deepEqual(wrong.slice(0, 3), []);
    return counts;
  };
  const { cut, left } = colored(findings);
  assert.ok(Math.abs(cut - 40 * 0.5 - 3 * 2) < 2, `${cut} mm² cut into the part and its bar`);
  assert.ok(Math.abs(left - 40 * 0.5) < 2, `${left} mm² left`);
  const { loose } = colored({ is_loose: true });
  assert.ok(loose > 600 && loose < 40 * 20 - 8 * 8, `${loose} mm² of a loose part`);
  assert.deepEqual(colored({}), { cut: 0, left: 0, loose: 0 });
  // Of a corner out of reach, what no cut touches is marked, if a finding is about corners.
  const corners = [{ at: [18, 14], reach: 1 }];
  scene.findings = [{ code: "PB216" }];
  const corner = colored({ corners }).left;
  assert.ok(Math.abs(corner - (1 - Math.PI / 4)) < 0.1, `${corner} mm² out of reach`);
  scene.findings = [];
  assert.equal(colored({ corners }).left, 0);
  // So is the material in an outline that is not cut.
  const uncut = stockOf({ ...scene, uncut: [ring([25, 6], [35, 14])] });
  const isMarked = (x, y) => {
    const { columns, texel, cutting } = uncut.map;
    const at = Math.floor((y - cutting.box[1]) / texel) * columns + Math.floor((x - cutting.box[0]) / texel);
    const [, green, blue] = uncut.colors.subarray(at * 4, at * 4 + 3);
    return blue > 140 && green < 90;
  };
  assert.deepEqual([[25.2, 6.2], [34.8, 13.8], [24.8, 10], [30, 14.2]].map(([x, y]) => isMarked(x, y)), [true, true, false, false]);
}

{
  // Long programs: zigzags on growing circles, pass by pass.
  const moves = [move("plunge", [20, 0, 5], [20, 0, -1])];
  for (let step = 1; step < 200_000; step++) {
    const [angle, radius] = [step * 0.013, 20 + (step % 20_000) / 200 + (step % 2) * 3];
    moves.push(move("mill", moves.at(-1).to, [radius * Math.cos(angle), radius * Math.sin(angle), -(1 + Math.floor(step / 20_000))]));
  }
  const timed = (act) => {
    const begun = performance.now();
    act();
    return performance.now() - begun;
  };
  let stock;
  const made = timed(() => (stock = stockOf(plain(2, 0, moves))));
  const first = timed(() => stock.seek(200_000));
  const spread = (steps) => steps.map((to) => timed(() => stock.seek(to))).sort((a, b) => a - b);
  const said = (all) => `median ${all[all.length >> 1].toFixed(0)} ms, worst ${all.at(-1).toFixed(0)} ms`;
  console.log(`200,000 moves: made ${made.toFixed(0)} ms, first cut ${first.toFixed(0)} ms, ${stock.map.columns} x ${stock.map.rows} texels`);
  console.log("  jumps:", said(spread(Array.from({ length: 60 }, () => Math.floor(random() * 200_001)))));
  stock.seek(60_000);
  console.log("  forwards by 40:", said(spread(Array.from({ length: 100 }, (_, step) => 60_000 + step * 40))));
  console.log("  backwards by 40:", said(spread(Array.from({ length: 100 }, (_, step) => 64_000 - step * 40))));
}
rmSync(directory, { recursive: true });
