// Checks the contrast of the page's colours in both themes, from its CSS variables: node contrast-test.mjs.
import { readFileSync } from "node:fs";
import assert from "node:assert/strict";

const read = (name) => readFileSync(new URL(name, import.meta.url), "utf8");
const style = read("style.css");
const variables = (rule) => Object.fromEntries([...rule.matchAll(/--([\w-]+):(#[0-9a-f]{6})/g)].map(([, name, value]) => [name, value]));
const light = variables(/:root\{([^}]*)\}/.exec(style)[1]);
const dark = { ...light, ...variables(/\[data-theme=dark\]\{([^}]*)\}/.exec(style)[1]) };

/** Relative luminance as WCAG defines it. */
function luminance(color) {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16) / 255).map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a, b) {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const TEXTS = ["ink", "soft", "error", "warning", "good", "clamp"];
const LINES = ["line", "focus", "rapid", "faint", "element", "ahead", "clamp", "outline", "bar", "error", "warning", "good", "depth1", "depth2", "depth3", "depth4", "depth5"];

for (const [theme, colors] of Object.entries({ light, dark })) {
  const check = (name, on, least) => {
    const found = contrast(colors[name], colors[on]);
    assert.ok(found >= least, `${theme}: --${name} on --${on} has a contrast of ${found.toFixed(2)}, less than ${least}`);
    return found;
  };
  const texts = TEXTS.flatMap((name) => ["paper", "panel"].map((on) => check(name, on, 4.5)));
  texts.push(check("ink", "now", 4.5), check("ink", "edge", 4.5), check("soft", "now", 4.5), check("error", "now", 4.5));
  const lines = LINES.map((name) => check(name, "paper", 3));
  // On the stock as well: its moves, and the outline of a part.
  for (const name of ["rapid", "outline"]) check(name, "uncut", 3);
  // The deeper, the darker.
  for (let stop = 1; stop < 5; stop++) assert.ok(luminance(colors[`depth${stop}`]) > luminance(colors[`depth${stop + 1}`]), `${theme}: depth ${stop}`);
  console.log(`contrast, ${theme}: texts at least ${Math.min(...texts).toFixed(2)}, lines at least ${Math.min(...lines).toFixed(2)}`);
}

// Every colour in the style sheets is a variable, except in the definitions of the variables.
for (const name of ["style.css", "live.css", "local.css"]) {
  const rules = read(name).replace(/:root\{[^}]*\}|\[data-theme=dark\]\{[^}]*\}/g, "");
  assert.deepEqual(rules.match(/#[0-9a-f]{3,8}\b(?=[;}\s,)])/g) ?? [], [], name);
}
