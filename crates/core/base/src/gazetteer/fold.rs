//! Names without accents and case.

/// Letters, each before those that are taken for it.
const LETTERS: [&str; 19] = [
    "aàáâãäåāăąạảấầẩẫậắằẳẵặ",
    "cçćĉċč",
    "dďḍḏḑðđ",
    "eèéêëēĕėęěẹẻẽếềểễệə",
    "gĝğġģ",
    "hĥħḥḩẖ",
    "iìíîïĩīĭįıḯỉị",
    "jĵ",
    "kķḵ",
    "lĺļľł",
    "nñńņňṅ",
    "oòóôõöøōŏőơọỏốồổỗộớờởỡợ",
    "rŕŗřṟ",
    "sśŝşšșṣ",
    "tţťțṭŧ",
    "uùúûüũūŭůűųưụủứừửữự",
    "wŵ",
    "yýÿŷỳỵỷỹ",
    "zźżžẓẕ",
];

/// A text in small letters without accents; what is neither a letter nor a figure becomes a space, any apostrophe `'`.
pub(super) fn folded(text: &str) -> String {
    let mut folded = String::with_capacity(text.len());
    for letter in text.chars().flat_map(char::to_lowercase) {
        match letter {
            '\u{300}'..='\u{36f}' => {}
            'ß' => folded.push_str("ss"),
            'æ' => folded.push_str("ae"),
            'œ' => folded.push_str("oe"),
            'þ' => folded.push_str("th"),
            '\'' | '`' | '‘' | '’' | 'ʻ' => folded.push('\''),
            _ if letter.is_ascii_alphanumeric() => folded.push(letter),
            _ if letter.is_alphanumeric() => {
                let plain = LETTERS.iter().find(|it| it.contains(letter));
                folded.push(plain.and_then(|it| it.chars().next()).unwrap_or(letter));
            }
            _ => folded.push(' '),
        }
    }
    folded
}
