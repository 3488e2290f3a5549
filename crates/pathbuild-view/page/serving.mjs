// The server for the tests and measurements of the live page.
import { spawn } from "node:child_process";
import { createInterface } from "node:readline";

/** Serves a library, or some drawings of it, and returns the address once everything is checked. */
export async function serve(pathbuild, library, at, ...drawings) {
  const server = spawn(pathbuild, ["watch", ...drawings, "--serve", at, "--no-cache", "--lang", "en"], { cwd: library, stdio: ["ignore", "ignore", "pipe"] });
  let address;
  for await (const line of createInterface({ input: server.stderr })) {
    address ??= /serving at (\S+)/.exec(line)?.[1];
    if (line.startsWith("watching ")) break;
  }
  server.stderr.resume();
  return { server, address };
}
