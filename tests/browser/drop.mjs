// Files that a journey drops on the page.

/** Drops files on the middle of the window, as a hand does. */
export async function drop(page, files) {
  const transfer = await page.evaluateHandle((list) => {
    const made = new DataTransfer();
    for (const { name, base64 } of list) {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      made.items.add(new File([bytes], name));
    }
    return made;
  }, files.map(({ name, buffer }) => ({ name, base64: buffer.toString("base64") })));
  for (const kind of ["dragenter", "dragover", "drop"]) await page.dispatchEvent("#app", kind, { dataTransfer: transfer });
}
