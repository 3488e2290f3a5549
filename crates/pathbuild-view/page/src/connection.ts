// Requests to the server of this page. If other machines may connect, the server requires the token from the page's address.

import { Scene } from "./scene.js";
import { DroppedProgram, ProgramSettings } from "./programs.js";
import { LibraryNews, Refused, Source } from "./source.js";

const TOKEN = "pathbuild-token";

export class Connection implements Source {
  private headers: Record<string, string> = {};
  private run: string | null = null;

  constructor() {
    const token = takeToken();
    if (token) this.headers = { Authorization: `Bearer ${token}` };
  }

  async library(since: number, most?: number): Promise<LibraryNews> {
    const part = most === undefined ? "" : `&most=${most}`;
    return (await this.get(`api/library?since=${since}${part}`)).json();
  }

  async scene(file: string, path: string | null): Promise<Scene> {
    return (await this.get(`api/scene?${query(file, path)}`)).json();
  }

  async picture(file: string, path: string | null): Promise<Blob> {
    return (await this.get(`api/picture?${query(file, path)}`)).blob();
  }

  /** Sends the program to the server of this page, which does not store it. */
  async program({ name, bytes }: DroppedProgram, { dialect, cutter, surface }: ProgramSettings): Promise<Scene> {
    const given = Object.entries({ name, dialect, cutter, surface }).filter(([, value]) => value !== "");
    return (await this.get(`api/program?${new URLSearchParams(given)}`, { method: "POST", body: bytes })).json();
  }

  /** Calls `hear` for each change until the connection ends. If the server was restarted, reloads the page, because the new one may differ. */
  async events(hear: () => void): Promise<void> {
    const answer = await this.get("api/events");
    const reader = answer.body!.pipeThrough(new TextDecoderStream()).getReader();
    let rest = "";
    for (;;) {
      const { value, done } = await reader.read();
      if (done) return;
      const lines = (rest + value).split("\n");
      rest = lines.pop()!;
      for (const line of lines) {
        if (!line.startsWith("data: ")) continue;
        const run = line.slice(6).split(" ")[0];
        if (this.run !== null && this.run !== run) location.reload();
        this.run = run;
        hear();
      }
    }
  }

  private async get(what: string, request: RequestInit = {}): Promise<Response> {
    const answer = await fetch(what, { ...request, headers: this.headers, cache: "no-store" });
    if (!answer.ok) throw new Refused(answer.status);
    return answer;
  }
}

function query(file: string, path: string | null): string {
  const wanted = new URLSearchParams({ file });
  if (path !== null) wanted.set("path", path);
  return wanted.toString();
}

/** Returns the token of the address, or of an earlier visit. Removes it from the address, so that it is not visible or kept in the history. */
function takeToken(): string | null {
  const from = new URLSearchParams(location.hash.slice(1));
  const token = from.get("token");
  if (token === null) return sessionStorage.getItem(TOKEN);
  sessionStorage.setItem(TOKEN, token);
  from.delete("token");
  const rest = from.toString();
  history.replaceState(null, "", rest ? `#${rest}` : location.pathname);
  return token;
}
