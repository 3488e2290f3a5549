// Files that the user drops or picks.

import { Files } from "./compiler.js";

/** Upper bound on the number of files: the page and the compiler each hold a copy in memory. */
export const MOST_FILES = 20_000;
export const MOST_BYTES = 256 << 20;

/** Error for files that are too many or too large. */
export class TooMuch extends Error {
  constructor(
    readonly files: number,
    readonly bytes: number,
  ) {
    super("too much");
  }
}

/** Files given by the user, by their paths, and whether they form a folder. */
export interface Given {
  isFolder: boolean;
  files: Files;
}

type Placed = [string, File];

/** Reads files picked with a button. */
export function picked(list: FileList): Promise<Given> {
  const files = [...list].map((file): Placed => [file.webkitRelativePath || file.name, file]);
  return given(files);
}

/** Extension of Chromium that TypeScript does not declare. */
interface Dropped extends DataTransferItem {
  getAsFileSystemHandle?(): Promise<Handle | null>;
}

type Handle = { kind: "file"; name: string; getFile(): Promise<File> } | { kind: "directory"; name: string; values(): AsyncIterable<Handle> };

/** Reads dropped files. The items of a drop must be accessed synchronously. */
export async function dropped(data: DataTransfer): Promise<Given> {
  const all = [...data.items].map((item: Dropped) => ({
    file: item.getAsFile(),
    entry: item.webkitGetAsEntry(),
    // Chromium refuses handles of directories that it considers part of the system.
    handle: item.getAsFileSystemHandle?.().catch(() => null),
  }));
  const files: Placed[] = [];
  for (const { file, entry, handle } of all) {
    if (entry?.isDirectory) {
      // On a page opened as a file, Chromium reads folders only through handles.
      const folder = await handle;
      await (folder ? unfold(folder, folder.name, files) : walk(entry, files));
    } else if (file) files.push([file.name, file]);
  }
  return given(files);
}

async function unfold(handle: Handle, place: string, into: Placed[]): Promise<void> {
  if (isHidden(place)) return;
  if (into.length > MOST_FILES) throw new TooMuch(into.length, 0);
  if (handle.kind === "file") into.push([place, await handle.getFile()]);
  else for await (const inner of handle.values()) await unfold(inner, `${place}/${inner.name}`, into);
}

async function walk(entry: FileSystemEntry, into: Placed[]): Promise<void> {
  if (isHidden(entry.fullPath)) return;
  if (into.length > MOST_FILES) throw new TooMuch(into.length, 0);
  if (entry.isFile) {
    const file = await new Promise<File>((answer, fail) => (entry as FileSystemFileEntry).file(answer, fail));
    into.push([entry.fullPath.replace(/^\//, ""), file]);
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((answer, fail) => reader.readEntries(answer, fail));
    if (some.length === 0) return;
    for (const inner of some) await walk(inner, into);
  }
}

/** Whether a file is hidden, as in .git, which may be large. Ignore files (.gitignore) do not count as hidden. */
function isHidden(place: string): boolean {
  const parts = place.split("/").filter((part) => part !== "");
  return parts.some((part, index) => part.startsWith(".") && !(index === parts.length - 1 && /^\.(git)?ignore$/.test(part)));
}

async function given(all: Placed[]): Promise<Given> {
  const placed = all.filter(([place]) => !isHidden(place));
  const bytes = placed.reduce((sum, [, file]) => sum + file.size, 0);
  if (placed.length > MOST_FILES || bytes > MOST_BYTES) throw new TooMuch(placed.length, bytes);
  const folder = /^[^/]*\//.exec(placed[0]?.[0] ?? "")?.[0];
  const isFolder = folder !== undefined && placed.every(([place]) => place.startsWith(folder));
  const files: Files = new Map();
  for (const [place, file] of placed) files.set(isFolder ? place.slice(folder.length) : place, await read(place, file));
  return { isFolder, files };
}

async function read(place: string, file: File): Promise<ArrayBuffer> {
  try {
    return await file.arrayBuffer();
  } catch (error) {
    throw new Error(`${place}: ${error instanceof Error ? error.message : error}`);
  }
}

/** Returns the files after more were given: a folder replaces all; a drawing replaces the one file with its name, or else is added. */
export function joined(before: Files, given: Given): Files {
  if (given.isFolder || before.size === 0) return given.files;
  const files = new Map(before);
  for (const [place, bytes] of given.files) {
    const same = [...before.keys()].filter((known) => known === place || known.endsWith(`/${place}`));
    files.set(same.length === 1 ? same[0] : place, bytes);
  }
  return files;
}
