// The page, of a single embedded scene or of a watched library.

import { Connection } from "./connection.js";
import { dropped, picked } from "./files.js";
import { live } from "./live.js";
import { DroppedProgram, isProgram } from "./programs.js";
import { show } from "./viewer.js";

/** Opens programs that the user drops or picks. Dropped drawings are ignored: the page shows those of the library. */
function takePrograms(open: (program: DroppedProgram) => void): void {
  const take = async (given: ReturnType<typeof picked>) => {
    const { isFolder, files } = await given;
    if (isFolder) return;
    for (const [name, bytes] of files) if (isProgram(name)) open({ name, bytes });
  };
  const input = document.getElementById("programs") as HTMLInputElement;
  document.getElementById("pick-program")!.addEventListener("click", () => input.click());
  input.addEventListener("change", () => input.files && void take(picked(input.files)).then(() => (input.value = "")));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer) void take(dropped(event.dataTransfer));
  });
}

/** Shows the still picture. It is in a `noscript` element, which the browser does not parse: it is large, and needed only without WebGL2. */
function drawStill(): void {
  const still = document.getElementById("still")!;
  const text = still.querySelector("noscript")?.textContent;
  if (text) still.innerHTML = text;
}

const scene = document.getElementById("scene");
if (scene) show(JSON.parse(scene.textContent!), false, drawStill);
else takePrograms(live(new Connection()));
document.documentElement.dataset.ready = "true";
