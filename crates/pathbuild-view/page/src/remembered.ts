// Choices of the user that apply to all pages of this browser, as far as it lets a page store them.

type Choice = "lang" | "theme";

export function remembered(choice: Choice): string | null {
  try {
    return localStorage.getItem(`pathbuild-${choice}`);
  } catch {
    return null;
  }
}

export function remember(choice: Choice, value: string): void {
  try {
    localStorage.setItem(`pathbuild-${choice}`, value);
  } catch {
    // The choice applies to this page only.
  }
}
