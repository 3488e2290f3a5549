// The worker that the compiler runs in. It knows of one instance and one question at a time; a trap ends the instance.

/** What crates/pathbuild-wasm/src/exports.rs offers. */
interface Exports {
  memory: WebAssembly.Memory;
  room(length: number): number;
  answer(): number;
  answered(): number;
  panicked(): number;
  panic_text(): number;
}

/** A question: a line of JSON, and bytes. */
export interface Asked {
  head: string;
  bytes?: ArrayBuffer;
}

/** An answer, or why there is none and never will be. */
export type Answered = { head: string; bytes: Uint8Array<ArrayBuffer> } | { trap: string };

/** What the compiler asks of the browser: crates/pathbuild-encoding/src/browser.rs. */
const imports = { browser: { decode } };

let begun: Promise<Exports> | null = null;
let memory: WebAssembly.Memory;

self.addEventListener("message", async ({ data }: MessageEvent<ArrayBuffer | Asked>) => {
  if (data instanceof ArrayBuffer) {
    begun = WebAssembly.instantiate(data, imports).then(({ instance }) => {
      const exports = instance.exports as unknown as Exports;
      memory = exports.memory;
      return exports;
    });
    begun.catch((error) => tell({ trap: String(error) }));
    return;
  }
  const exports = await begun!;
  try {
    tell(ask(exports, data));
  } catch (error) {
    tell({ trap: said(exports) || String(error) });
  }
});

function tell(answer: Answered): void {
  postMessage(answer, "trap" in answer ? {} : { transfer: [answer.bytes.buffer] });
}

function ask(exports: Exports, { head, bytes }: Asked): Answered {
  const line = new TextEncoder().encode(`${head}\n`);
  const room = exports.room(line.length + (bytes?.byteLength ?? 0)) >>> 0;
  const memory = new Uint8Array(exports.memory.buffer);
  memory.set(line, room);
  if (bytes) memory.set(new Uint8Array(bytes), room + line.length);
  const length = exports.answer() >>> 0;
  const answer = at(exports, exports.answered(), length);
  const end = answer.indexOf(10);
  return { head: new TextDecoder().decode(answer.subarray(0, end)), bytes: answer.slice(end + 1) };
}

/** Decodes a text in code page `label`; of a damaged one gives back the length's complement. */
function decode(label: number, labelLength: number, from: number, length: number, to: number, room: number): number {
  const bytes = (place: number, size: number) => new Uint8Array(memory.buffer, place >>> 0, size >>> 0);
  const name = new TextDecoder().decode(bytes(label, labelLength));
  const write = (fatal: boolean) => new TextEncoder().encodeInto(new TextDecoder(name, { fatal }).decode(bytes(from, length)), bytes(to, room)).written;
  try {
    return write(true);
  } catch {
    return ~write(false);
  }
}

/** What a panic said. */
function said(exports: Exports): string {
  try {
    return new TextDecoder().decode(at(exports, exports.panic_text(), exports.panicked() >>> 0));
  } catch {
    return "";
  }
}

function at(exports: Exports, place: number, length: number): Uint8Array {
  return new Uint8Array(exports.memory.buffer, place >>> 0, length);
}
