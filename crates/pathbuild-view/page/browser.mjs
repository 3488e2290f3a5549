// The browsers that the pages are tried in: Debian's chromium, or with BROWSER=firefox Debian's firefox-esr. WebGL in Firefox needs a
// display: xvfb-run.
import playwright, { chromium } from "playwright-core";

export const isFirefox = process.env.BROWSER === "firefox";

/** Starts the browser with WebGL in software; the arguments are added for Chromium. */
export function launch(...args) {
  if (isFirefox) return launchFirefox({ "webgl.force-enabled": true });
  // On a busy machine the watchdog ends the process that draws, and the page loses its picture.
  return launchChromium("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-watchdog", ...args);
}

/** Starts the browser without WebGL. */
export function launchWithoutWebGL() {
  if (isFirefox) return launchFirefox({ "webgl.disabled": true });
  return launchChromium("--disable-gpu", "--disable-3d-apis", "--disable-webgl", "--disable-webgl2");
}

function launchFirefox(firefoxUserPrefs) {
  // Uses WebDriver BiDi, which every Firefox supports.
  return playwright._bidiFirefox.launch({ channel: "moz-firefox", executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr", headless: !process.env.DISPLAY, firefoxUserPrefs, env: { ...process.env, LIBGL_ALWAYS_SOFTWARE: "1" } });
}

function launchChromium(...args) {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", ...args] });
}
