/** The fragment of the page's address; as it stands there where its escapes are damaged, as in a link that was cut. */
export function fragment() {
  const text = location.hash.slice(1);
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
