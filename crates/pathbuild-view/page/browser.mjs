// The browsers that the pages are tried in: Debian's chromium, or with BROWSER=firefox Debian's firefox-esr. WebGL in Firefox needs a
// display: xvfb-run.
import playwright, { chromium } from "playwright-core";

export const isFirefox = process.env.BROWSER === "firefox";

export function launch(...args) {
  if (isFirefox) {
    const firefoxUserPrefs = { "webgl.force-enabled": true };
    // Over WebDriver BiDi, which every Firefox speaks.
    return playwright._bidiFirefox.launch({ channel: "moz-firefox", executablePath: process.env.FIREFOX ?? "/usr/bin/firefox-esr", headless: !process.env.DISPLAY, firefoxUserPrefs, env: { ...process.env, LIBGL_ALWAYS_SOFTWARE: "1" } });
  }
  const software = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: [...software, ...args] });
}
