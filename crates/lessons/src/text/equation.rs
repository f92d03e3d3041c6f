//! Equations in `LaTeX`, as `MathML`.

use std::fmt::Write as _;

use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser, RenderConfig, Storage, push_mathml};

use super::error::TextError;
use super::symbol::Symbol;

/// `MathML` of an equation, its symbols marked with the parts of the figure that show them.
pub(super) fn mathml(
    equation: &str,
    display: bool,
    symbols: &[Symbol<'_>],
) -> Result<String, TextError> {
    let fault = |reason: String| TextError::Equation {
        equation: equation.to_owned(),
        reason,
    };
    let storage = Storage::new();
    let events: Result<Vec<_>, _> = Parser::new(equation, &storage).collect();
    let events = events.map_err(|error| fault(error.to_string()))?;
    let config = RenderConfig {
        display_mode: if display {
            DisplayMode::Block
        } else {
            DisplayMode::Inline
        },
        ..RenderConfig::default()
    };
    let mut made = String::new();
    let whole = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    push_mathml(&mut made, whole, config).map_err(|error| fault(error.to_string()))?;
    for symbol in symbols.iter().filter(|symbol| !symbol.part.is_empty()) {
        let alone = mathml(symbol.symbol, false, &[])?;
        if let Some(inner) = content(&alone) {
            let mut marked = String::new();
            let _ = write!(
                marked,
                r#"<mrow class="symbol" data-symbol="{}">{inner}</mrow>"#,
                symbol.part
            );
            made = made.replace(inner, &marked);
        }
    }
    Ok(made)
}

/// Content of the outermost element.
fn content(mathml: &str) -> Option<&str> {
    let begin = mathml.find('>')? + 1;
    let end = mathml.rfind("</math>")?;
    (begin < end).then(|| &mathml[begin..end])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symbol_is_marked_wherever_it_stands() {
        let symbols = [Symbol {
            symbol: "K",
            part: "gain",
            meaning: "gain",
        }];
        let made = mathml(
            r"\hat x^+ = \hat x + K \nu, \; K = P H^\top S^{-1}",
            true,
            &symbols,
        )
        .unwrap();
        assert_eq!(made.matches(r#"data-symbol="gain""#).count(), 2, "{made}");
        assert!(made.contains(r#"display="block""#), "{made}");
    }

    #[test]
    fn what_is_no_equation_is_named() {
        let fault = mathml(r"\frac{1}", false, &[]).unwrap_err();
        assert!(fault.to_string().contains(r"\frac{1}"), "{fault}");
    }
}
