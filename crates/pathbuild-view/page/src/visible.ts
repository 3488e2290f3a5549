// Names and texts are untrusted: control characters in them are escaped, as on a terminal.

const ACTS =
  /[\u0000-\u0009\u000b-\u001f\u007f-\u009f\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b-\u200f\u2028-\u202e\u2060-\u206f\u3164\ufe00-\ufe0f\ufeff\uffa0\ufff0-\ufffb\ufffe\uffff\u{13430}-\u{1343f}\u{1bca0}-\u{1bca3}\u{1d173}-\u{1d17a}\u{e0000}-\u{e0fff}]/gu;

/** Escapes characters that reverse the text direction or are invisible. */
export function visible(text: string): string {
  return text.replace(ACTS, (character) => `\\u{${character.codePointAt(0)!.toString(16)}}`);
}
