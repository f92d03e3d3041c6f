// Names in many scripts, on the map and in the list. Code for letters that the page has not is taken out of it
// (xtask/never_called.toml): that for arranging any script has to be there still.
export const name = "names in every script are shown, and those that the page has no letters for end nothing";
export const tags = ["plan"];

const names = {
  Greek: "Αεροδρόμιο", Cyrillic: "Аэродром «Ё»", Vietnamese: "Sân bay Đà Nẵng", decomposed: "a\u0302\u0323e\u0301o\u0308\u0323",
  Arabic: "مطار برلين", Hebrew: "נְמַל תְּעוּפָה", Syriac: "ܡܛܪܐ", Devanagari: "हवाई क्षेत्र र्क्षि", Bengali: "বিমানবন্দর ক্ষেত্র",
  Gurmukhi: "ਹਵਾਈ ਅੱਡਾ", Tamil: "விமான நிலையம்", Telugu: "విమానాశ్రయం", Kannada: "ವಿಮಾನ ನಿಲ್ದಾಣ", Malayalam: "വിമാനത്താവളം",
  Sinhala: "ගුවන් තොටුපළ", Thai: "สนามบินน้ำ", Lao: "ສະໜາມບິນນໍ້າ", Khmer: "ព្រលានយន្តហោះ", Myanmar: "လေဆိပ်ကြီး", Tibetan: "གནམ་གྲུ་ཐང་།",
  Hangul: "공항 \u1112\u1161\u11ab", Han: "空港・機場", Mongolian: "ᠮᠣᠩᠭᠣᠯ", Nko: "ߒߞߏ", Georgian: "აეროპორტი", Armenian: "Օդանավակայան",
  Amharic: "አውሮፕላን", Cherokee: "ᏣᎳᎩ", Balinese: "ᬩᬮᬶ", Javanese: "ꦗꦮ", emoji: "✈️ 👨‍👩‍👧 🇨🇭", mixed: "abc עברית हिन्दी 中文 e\u0336\u0337\u0338\u0301\u0302",
  isolated: "\u2067עברית\u2069 \u200d\u200c\ufeff\u00ad",
};

export async function run(page, tools) {
  await tools.waitReady();
  const { origin } = await tools.waitFor((s) => s.run_steps > 0 && s.map.known, "the demo", 150_000);
  const features = Object.values(names).map((text, i) => ({
    type: "Feature",
    properties: { name: text },
    geometry: { type: "Point", coordinates: [origin[1] + 0.0012 * (i % 6), origin[0] + 0.0009 * Math.floor(i / 6)] },
  }));
  const text = JSON.stringify({ type: "FeatureCollection", features });
  await page.setInputFiles("#files", [{ name: "names.geojson", mimeType: "application/json", buffer: Buffer.from(text) }]);
  const named = (state) => Object.values(names).filter((text) => state.landmarks.some((l) => l.name === text));
  await tools.waitFor((s) => named(s).length === features.length, "the landmarks with their names", 60_000);
  await tools.showLandmarks();
  await tools.drawn();
  await tools.screenshot("scripts");
  // The list is longer than the panel: its end is scrolled to.
  const shows = async (script) => (await tools.a11y()).some((node) => `${node.label ?? ""}${node.value ?? ""}`.includes(names[script]));
  tools.check(await shows("Greek"), "the list does not show the Greek name");
  const suggest = tools.middle(await tools.find("Button", /^Suggest \d+ landmarks/));
  await page.mouse.move(suggest.x, suggest.y + 200);
  for (let turns = 0; turns < 20 && !(await shows("isolated")); turns += 1) await page.mouse.wheel(0, 300);
  tools.check(await shows("isolated"), "the list does not show the last name");
  const after = await tools.state();
  tools.check(named(after).length === features.length, "a name was lost");
  await tools.screenshot("scripts-further");
}
