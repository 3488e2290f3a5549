// The worker that runs the compiler. It has one instance and handles one question at a time; a trap ends the instance.

import { type Instance, instantiate } from "../../../../packaging/npm/index.js";

/** A question to the compiler: a line of JSON, and bytes. */
export interface CompilerRequest {
  head: string;
  bytes?: ArrayBuffer;
}

/** The compiler's answer, or the trap that ended the instance. */
export type CompilerResponse = { head: string; bytes: Uint8Array<ArrayBuffer> } | { trap: string };

let begun: Promise<Instance> | null = null;

self.addEventListener("message", async ({ data }: MessageEvent<ArrayBuffer | CompilerRequest>) => {
  if (data instanceof ArrayBuffer) {
    begun = instantiate(data);
    begun.catch((error) => tell({ trap: String(error) }));
    return;
  }
  const instance = await begun!;
  try {
    tell(instance.ask(data.head, new Uint8Array(data.bytes ?? [])));
  } catch (error) {
    tell({ trap: error instanceof Error ? error.message : String(error) });
  }
});

function tell(answer: CompilerResponse): void {
  postMessage(answer, "trap" in answer ? {} : { transfer: [answer.bytes.buffer] });
}
