// The compiler as WebAssembly; index.d.ts documents it.

/** A panic or trap ended the instance: it answers no more. */
export class Trap extends Error {}

export class Instance {
  #exports;

  constructor(exports) {
    this.#exports = exports;
  }

  ask(head, bytes = new Uint8Array()) {
    try {
      return this.#answer(new TextEncoder().encode(`${head}\n`), bytes);
    } catch (error) {
      throw new Trap(this.#panic() || String(error), { cause: error });
    }
  }

  #answer(line, bytes) {
    const { room, answer, answered } = this.#exports;
    // The call may move the memory.
    const place = room(line.length + bytes.length);
    this.#bytes(place, line.length).set(line);
    this.#bytes(place + line.length, bytes.length).set(bytes);
    const length = answer();
    const reply = this.#bytes(answered(), length);
    const end = reply.indexOf(10);
    return { head: new TextDecoder().decode(reply.subarray(0, end)), bytes: reply.slice(end + 1) };
  }

  #panic() {
    try {
      const { panicked, panic_text } = this.#exports;
      const length = panicked();
      return new TextDecoder().decode(this.#bytes(panic_text(), length));
    } catch {
      return "";
    }
  }

  /** WebAssembly passes addresses as signed numbers. */
  #bytes(place, length) {
    return new Uint8Array(this.#exports.memory.buffer, place >>> 0, length >>> 0);
  }
}

export async function instantiate(wasm) {
  let memory;
  const bytes = (place, size) => new Uint8Array(memory.buffer, place >>> 0, size >>> 0);
  // The compiler leaves code pages to the browser. For a damaged text it gets the complement of the length.
  const decode = (label, labelLength, from, length, to, room) => {
    const name = new TextDecoder().decode(bytes(label, labelLength));
    const write = (fatal) => new TextEncoder().encodeInto(new TextDecoder(name, { fatal }).decode(bytes(from, length)), bytes(to, room)).written;
    try {
      return write(true);
    } catch {
      return ~write(false);
    }
  };
  const made = await WebAssembly.instantiate(wasm, { browser: { decode } });
  // Of a module, it is the instance itself.
  const { exports } = made.instance ?? made;
  memory = exports.memory;
  return new Instance(exports);
}

export async function load(wasm) {
  return new Compiler(await instantiate(wasm));
}

export class Compiler {
  #instance;

  constructor(instance) {
    this.#instance = instance;
  }

  put(file, content) {
    this.#ask({ ask: "put", file }, typeof content === "string" ? new TextEncoder().encode(content) : content);
  }

  open(options = {}) {
    return this.#ask({ ask: "open", options }).head;
  }

  paths(file) {
    return this.#ask({ ask: "index", file }).head.rows;
  }

  check(file, path) {
    return this.#ask({ ask: "check", file, path }).head.row;
  }

  statistics() {
    return this.#ask({ ask: "statistics" }).head.statistics;
  }

  scene(file, path = null) {
    const text = this.#text({ ask: "scene", file, path });
    return text === null ? null : JSON.parse(text);
  }

  picture(file, path = null) {
    return this.#text({ ask: "picture", file, path });
  }

  emit(places) {
    const { head, bytes } = this.#ask({ ask: "emit", places });
    let end = 0;
    const files = head.files.map(({ name, size }) => ({ name, bytes: bytes.slice(end, (end += size)) }));
    return { ...head, files };
  }

  #text(question) {
    const { head, bytes } = this.#ask(question);
    return head.seen ? new TextDecoder().decode(bytes) : null;
  }

  #ask(question, content) {
    const { head, bytes } = this.#instance.ask(JSON.stringify(question), content);
    // `put` has no answer.
    const answer = JSON.parse(head) ?? {};
    if (answer.wrong !== undefined) throw new Error(answer.wrong);
    return { head: answer, bytes };
  }
}
