//! The functions that expressions know.

use std::f64::consts::PI;

/// A function that expressions know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "told in the table below")]
pub enum Function {
    Abs,
    Sqrt,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Exp,
    Log,
    Min,
    Max,
    Hypot,
    Wrap180,
    Wrap360,
    Rad,
    Deg,
    Derivative,
    Integral,
    Smooth,
    Shift,
}

/// Description of a function.
#[derive(Clone, Copy, Debug)]
pub struct FunctionInfo {
    /// The function.
    pub function: Function,
    /// Its name.
    pub name: &'static str,
    /// Its arguments, as people write them.
    pub arguments: &'static str,
    /// Result of the function, in words.
    pub about: &'static str,
}

const fn info(
    function: Function,
    name: &'static str,
    arguments: &'static str,
    about: &'static str,
) -> FunctionInfo {
    FunctionInfo {
        function,
        name,
        arguments,
        about,
    }
}

/// Every function, in reading order.
pub const FUNCTIONS: [FunctionInfo; 22] = [
    info(Function::Derivative, "derivative", "x", "change per second"),
    info(
        Function::Integral,
        "integral",
        "x",
        "sum over time, in seconds, from 0 on",
    ),
    info(
        Function::Smooth,
        "smooth",
        "x, seconds",
        "mean of so many seconds around",
    ),
    info(
        Function::Shift,
        "shift",
        "x, seconds",
        "so many seconds later",
    ),
    info(Function::Abs, "abs", "x", "amount"),
    info(Function::Sqrt, "sqrt", "x", "square root"),
    info(
        Function::Hypot,
        "hypot",
        "x, y, …",
        "root of the sum of squares",
    ),
    info(Function::Min, "min", "x, y, …", "least"),
    info(Function::Max, "max", "x, y, …", "greatest"),
    info(Function::Wrap180, "wrap180", "degrees", "into −180 to 180"),
    info(Function::Wrap360, "wrap360", "degrees", "into 0 to 360"),
    info(Function::Rad, "rad", "degrees", "as radians"),
    info(Function::Deg, "deg", "radians", "as degrees"),
    info(Function::Sin, "sin", "radians", "sine"),
    info(Function::Cos, "cos", "radians", "cosine"),
    info(Function::Tan, "tan", "radians", "tangent"),
    info(Function::Asin, "asin", "x", "angle of a sine, radians"),
    info(Function::Acos, "acos", "x", "angle of a cosine, radians"),
    info(Function::Atan, "atan", "x", "angle of a tangent, radians"),
    info(Function::Atan2, "atan2", "y, x", "angle of (x, y), radians"),
    info(Function::Exp, "exp", "x", "e to the power of"),
    info(Function::Log, "log", "x", "natural logarithm"),
];

impl Function {
    /// The function of that name.
    pub fn named(name: &str) -> Option<Self> {
        let found = FUNCTIONS.iter().find(|info| info.name == name);
        found.map(|info| info.function)
    }

    /// Description of the function.
    pub fn info(self) -> &'static FunctionInfo {
        let found = FUNCTIONS.iter().find(|info| info.function == self);
        found.unwrap_or(&FUNCTIONS[0])
    }

    /// Fewest and most arguments, and both in words.
    pub(super) fn arguments(self) -> (usize, usize, &'static str) {
        match self {
            Self::Atan2 | Self::Smooth | Self::Shift => (2, 2, "two arguments"),
            Self::Min | Self::Max | Self::Hypot => (2, usize::MAX, "two arguments or more"),
            _ => (1, 1, "one argument"),
        }
    }

    /// Its value for a number, of functions of one number.
    pub(super) fn of_one(self, x: f64) -> f64 {
        match self {
            Self::Abs => x.abs(),
            Self::Sqrt => x.sqrt(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Exp => x.exp(),
            Self::Log => x.ln(),
            Self::Wrap180 => floor_modulo(x + 180.0, 360.0) - 180.0,
            Self::Wrap360 => floor_modulo(x, 360.0),
            Self::Rad => x * (PI / 180.0),
            Self::Deg => x * (180.0 / PI),
            _ => x,
        }
    }

    /// Its value for two numbers; a number that is missing (NaN) leaves the result missing.
    pub(super) fn of_two(self, x: f64, y: f64) -> f64 {
        let are_there = !x.is_nan() && !y.is_nan();
        match self {
            Self::Atan2 => x.atan2(y),
            Self::Hypot => x.hypot(y),
            Self::Min if are_there => x.min(y),
            Self::Max if are_there => x.max(y),
            _ => f64::NAN,
        }
    }
}

/// The remainder of `x / y` with the sign of `y`.
pub(super) fn floor_modulo(x: f64, y: f64) -> f64 {
    let rest = x % y;
    if rest != 0.0 && (rest < 0.0) != (y < 0.0) {
        rest + y
    } else {
        rest
    }
}
