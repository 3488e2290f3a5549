// The page: of one scene, which stands in it, or of a library that is watched.

import { Connection } from "./connection.js";
import { live } from "./live.js";
import { show } from "./viewer.js";

const scene = document.getElementById("scene");
if (scene) show(JSON.parse(scene.textContent!), false);
else live(new Connection());
document.documentElement.dataset.ready = "true";
