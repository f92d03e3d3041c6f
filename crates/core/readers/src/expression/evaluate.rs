//! The values of an expression.

use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

use super::function::floor_modulo;
use super::grid::at_times;
use super::nearest::nearest;
use super::tree::{ExpressionNode, ExpressionPart, Operator};
use super::{Expression, ExpressionError, Function, SeriesSource, TimedSamples, Trouble};
use super::{over_time, written};

/// Times that several parts share.
type Times = Rc<Vec<f64>>;

/// Numbers at some times: one for all of them, or one each.
enum Numbers {
    Same(f64),
    Each(Vec<f64>),
}

/// Numbers, what unit they have, and how much makes a full turn, of angles.
struct UnitValue {
    numbers: Numbers,
    unit: String,
    period: Option<f64>,
}

impl UnitValue {
    fn plain(numbers: Numbers) -> Self {
        Self {
            numbers,
            unit: String::new(),
            period: None,
        }
    }

    fn each(self, count: usize) -> Vec<f64> {
        match self.numbers {
            Numbers::Same(number) => vec![number; count],
            Numbers::Each(numbers) => numbers,
        }
    }
}

/// A series that was asked for.
struct RequestedSeries {
    times: Times,
    values: Vec<f64>,
    unit: String,
    period: Option<f64>,
}

struct ExpressionEvaluator<'a> {
    source: &'a dyn SeriesSource,
    loaded: RefCell<Vec<(String, Rc<RequestedSeries>)>>,
}

impl Expression {
    /// Its values, at the times of the first series that it names.
    ///
    /// # Errors
    /// A series that `source` has not, with the most similar name.
    ///
    /// ```
    /// # use pilotage_readers::bytes::MemoryBytes;
    /// use pilotage_readers::expression::Expression;
    /// use pilotage_readers::log::read_log;
    ///
    /// let text = "FMT, 1, 13, GPS, Qff, TimeUS,VelN,VelE\nGPS, 1000000, 3, 4\nGPS, 2000000, 5, 12\n";
    /// let log = read_log(&MemoryBytes::new("flight.log", text.as_bytes()))?.ok_or("no log")?;
    /// let speed = Expression::parse("hypot(GPS.VelN, GPS.VelE)")?.evaluate(&log)?;
    /// assert_eq!((speed.times, speed.values), (vec![1.0, 2.0], vec![5.0, 13.0]));
    /// assert!(Expression::parse("GPS.VelN +").is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn evaluate(&self, source: &dyn SeriesSource) -> Result<TimedSamples, ExpressionError> {
        let evaluator = ExpressionEvaluator {
            source,
            loaded: RefCell::default(),
        };
        let no_series = || ExpressionError::new(self.root.place.clone(), Trouble::NoSeries);
        let times = evaluator.times(&self.root)?.ok_or_else(no_series)?;
        let value = evaluator.value(&self.root, &times)?;
        let unit = value.unit.clone();
        let values = value.each(times.len());
        drop(evaluator);
        Ok(TimedSamples {
            times: Rc::unwrap_or_clone(times),
            values,
            unit,
        })
    }
}

impl ExpressionEvaluator<'_> {
    fn series(
        &self,
        name: &str,
        place: &Range<usize>,
    ) -> Result<Rc<RequestedSeries>, ExpressionError> {
        let is_named = |(own, _): &&(String, _)| own == name;
        if let Some((_, found)) = self.loaded.borrow().iter().find(is_named) {
            return Ok(found.clone());
        }
        let Some(samples) = self.source.samples(name) else {
            let names = self.source.names();
            let trouble = Trouble::UnknownSeries {
                name: name.to_owned(),
                nearest: nearest(name, names.iter().map(String::as_str)).map(written),
            };
            return Err(ExpressionError::new(place.clone(), trouble));
        };
        let period = samples.period();
        let series = Rc::new(RequestedSeries {
            times: Rc::new(samples.times),
            values: samples.values,
            unit: samples.unit,
            period,
        });
        (self.loaded.borrow_mut()).push((name.to_owned(), series.clone()));
        Ok(series)
    }

    /// The times of the first series named in a part, later where it is shifted; `None` without a series.
    fn times(&self, part: &ExpressionPart) -> Result<Option<Times>, ExpressionError> {
        if let ExpressionNode::Series(name) = &part.node {
            return Ok(Some(self.series(name, &part.place)?.times.clone()));
        }
        for inner in part.parts() {
            let Some(times) = self.times(inner)? else {
                continue;
            };
            return Ok(Some(match &part.node {
                ExpressionNode::Call(Function::Shift, arguments) => {
                    let seconds = seconds_of(Function::Shift, arguments)?;
                    Rc::new(times.iter().map(|time| time + seconds).collect())
                }
                _ => times,
            }));
        }
        Ok(None)
    }

    /// The values of a part at times.
    fn value(&self, part: &ExpressionPart, times: &Times) -> Result<UnitValue, ExpressionError> {
        Ok(match &part.node {
            ExpressionNode::Number(number) => UnitValue::plain(Numbers::Same(*number)),
            ExpressionNode::Time => UnitValue {
                unit: "s".to_owned(),
                ..UnitValue::plain(Numbers::Each(times.to_vec()))
            },
            ExpressionNode::Series(name) => {
                let series = self.series(name, &part.place)?;
                let values = if Rc::ptr_eq(&series.times, times) {
                    series.values.clone()
                } else {
                    at_times(&series.times, &series.values, series.period, times)
                };
                UnitValue {
                    numbers: Numbers::Each(values),
                    unit: series.unit.clone(),
                    period: series.period,
                }
            }
            ExpressionNode::Negative(inner) => {
                let value = self.value(inner, times)?;
                let numbers = map(value.numbers, |x| -x);
                UnitValue { numbers, ..value }
            }
            ExpressionNode::Binary(operator, parts) => {
                let [left, right] = &**parts;
                let (left, right) = (self.value(left, times)?, self.value(right, times)?);
                binary(*operator, left, right)
            }
            ExpressionNode::Call(function, arguments) => self.call(*function, arguments, times)?,
        })
    }

    fn call(
        &self,
        function: Function,
        arguments: &[ExpressionPart],
        times: &Times,
    ) -> Result<UnitValue, ExpressionError> {
        let first = &arguments[0];
        match function {
            Function::Derivative | Function::Integral | Function::Smooth => {
                let seconds = seconds_of(function, arguments)?;
                self.over_time(function, first, seconds, times)
            }
            Function::Shift => {
                let seconds = seconds_of(function, arguments)?;
                let own: Times = self.times(first)?.unwrap_or_else(|| times.clone());
                let is_own = own.len() == times.len()
                    && (own.iter().zip(times.iter())).all(|(own, time)| own + seconds == *time);
                if is_own {
                    return self.value(first, &own);
                }
                let earlier = Rc::new(times.iter().map(|time| time - seconds).collect());
                self.value(first, &earlier)
            }
            Function::Atan2 | Function::Hypot | Function::Min | Function::Max => {
                let mut value = self.value(first, times)?;
                for other in &arguments[1..] {
                    let other = self.value(other, times)?;
                    let unit = common_unit(&value, &other);
                    let numbers = join(value.numbers, other.numbers, |x, y| function.of_two(x, y));
                    value = UnitValue {
                        unit,
                        ..UnitValue::plain(numbers)
                    };
                }
                if function == Function::Atan2 {
                    "rad".clone_into(&mut value.unit);
                }
                Ok(value)
            }
            _ => {
                let value = self.value(first, times)?;
                let (unit, period) = after(function, &value);
                let numbers = map(value.numbers, |x| function.of_one(x));
                Ok(UnitValue {
                    numbers,
                    unit,
                    period,
                })
            }
        }
    }

    /// A function of a whole series, taken where the series has its own samples.
    fn over_time(
        &self,
        function: Function,
        part: &ExpressionPart,
        seconds: f64,
        times: &Times,
    ) -> Result<UnitValue, ExpressionError> {
        let own = self.times(part)?.unwrap_or_else(|| times.clone());
        let value = self.value(part, &own)?;
        let (unit, period) = (value.unit.clone(), value.period);
        let values = value.each(own.len());
        let (values, unit, period) = match function {
            Function::Derivative => {
                let change = over_time::derivative(&own, &values, period);
                (change, per_second(&unit), None)
            }
            Function::Integral => (
                over_time::integral(&own, &values),
                seconds_of_it(&unit),
                None,
            ),
            _ => {
                let mean = over_time::smooth(&own, &values, seconds, period);
                (mean, unit, period)
            }
        };
        let is_same = Rc::ptr_eq(&own, times);
        let numbers = Numbers::Each(if is_same {
            values
        } else {
            at_times(&own, &values, period, times)
        });
        Ok(UnitValue {
            numbers,
            unit,
            period,
        })
    }
}

/// The length of time that a function is given, checked; 0 for functions without one.
pub(super) fn seconds_of(
    function: Function,
    arguments: &[ExpressionPart],
) -> Result<f64, ExpressionError> {
    let (Function::Smooth | Function::Shift, [_, seconds]) = (function, arguments) else {
        return Ok(0.0);
    };
    let complain = |trouble| Err(ExpressionError::new(seconds.place.clone(), trouble));
    match constant(seconds) {
        None => complain(Trouble::NotConstant),
        Some(value) if !value.is_finite() => complain(Trouble::NotConstant),
        Some(value) if function == Function::Smooth && value <= 0.0 => {
            complain(Trouble::NotPositive)
        }
        Some(value) => Ok(value),
    }
}

/// The value of a part that names no series and no time.
pub(super) fn constant(part: &ExpressionPart) -> Option<f64> {
    let one = |part: &ExpressionPart| {
        constant(part).map(|number| UnitValue::plain(Numbers::Same(number)))
    };
    let same = |value: UnitValue| match value.numbers {
        Numbers::Same(number) => Some(number),
        Numbers::Each(_) => None,
    };
    match &part.node {
        ExpressionNode::Number(number) => Some(*number),
        ExpressionNode::Time | ExpressionNode::Series(_) => None,
        ExpressionNode::Negative(part) => constant(part).map(|number| -number),
        ExpressionNode::Binary(operator, parts) => {
            let [left, right] = &**parts;
            same(binary(*operator, one(left)?, one(right)?))
        }
        ExpressionNode::Call(function, arguments) => match function {
            Function::Derivative | Function::Integral | Function::Smooth | Function::Shift => None,
            Function::Atan2 | Function::Hypot | Function::Min | Function::Max => {
                let numbers: Option<Vec<f64>> = arguments.iter().map(constant).collect();
                numbers?.into_iter().reduce(|x, y| function.of_two(x, y))
            }
            _ => constant(&arguments[0]).map(|x| function.of_one(x)),
        },
    }
}

fn map(numbers: Numbers, of: impl Fn(f64) -> f64) -> Numbers {
    match numbers {
        Numbers::Same(number) => Numbers::Same(of(number)),
        Numbers::Each(mut numbers) => {
            for x in &mut numbers {
                *x = of(*x);
            }
            Numbers::Each(numbers)
        }
    }
}

fn join(left: Numbers, right: Numbers, of: impl Fn(f64, f64) -> f64) -> Numbers {
    match (left, right) {
        (Numbers::Same(x), Numbers::Same(y)) => Numbers::Same(of(x, y)),
        (Numbers::Same(x), right) => map(right, |y| of(x, y)),
        (left, Numbers::Same(y)) => map(left, |x| of(x, y)),
        (Numbers::Each(mut left), Numbers::Each(right)) => {
            for (x, y) in left.iter_mut().zip(&right) {
                *x = of(*x, *y);
            }
            Numbers::Each(left)
        }
    }
}

fn binary(operator: Operator, left: UnitValue, right: UnitValue) -> UnitValue {
    let truth = |holds: fn(&f64, &f64) -> bool| {
        move |x: f64, y: f64| {
            if x.is_nan() || y.is_nan() {
                f64::NAN
            } else {
                f64::from(u8::from(holds(&x, &y)))
            }
        }
    };
    let common = common_unit(&left, &right);
    let (x, y) = (left.numbers, right.numbers);
    let (numbers, unit) = match operator {
        Operator::Add => (join(x, y, |x, y| x + y), common),
        Operator::Subtract => (join(x, y, |x, y| x - y), common),
        Operator::Modulo => (join(x, y, floor_modulo), common),
        Operator::Multiply => (join(x, y, |x, y| x * y), String::new()),
        Operator::Divide => (join(x, y, |x, y| x / y), String::new()),
        Operator::Power => (join(x, y, f64::powf), String::new()),
        Operator::Less => (join(x, y, truth(|x, y| x < y)), String::new()),
        Operator::LessOrEqual => (join(x, y, truth(|x, y| x <= y)), String::new()),
        Operator::Greater => (join(x, y, truth(|x, y| x > y)), String::new()),
        Operator::GreaterOrEqual => (join(x, y, truth(|x, y| x >= y)), String::new()),
        Operator::Equal => (join(x, y, truth(|x, y| x == y)), String::new()),
        Operator::NotEqual => (join(x, y, truth(|x, y| x != y)), String::new()),
    };
    UnitValue {
        numbers,
        unit,
        period: None,
    }
}

/// The unit of a sum: that of both, or of the one that is no plain number.
fn common_unit(left: &UnitValue, right: &UnitValue) -> String {
    let is_number = |value: &UnitValue| matches!(value.numbers, Numbers::Same(_));
    if left.unit == right.unit || is_number(right) {
        left.unit.clone()
    } else if is_number(left) {
        right.unit.clone()
    } else {
        String::new()
    }
}

/// Unit and full turn after a function of one number.
fn after(function: Function, value: &UnitValue) -> (String, Option<f64>) {
    let (unit, period) = match function {
        Function::Abs => return (value.unit.clone(), None),
        Function::Wrap180 | Function::Wrap360 | Function::Deg => ("deg", Some(360.0)),
        Function::Rad => ("rad", Some(std::f64::consts::TAU)),
        Function::Asin | Function::Acos | Function::Atan => ("rad", None),
        _ => ("", None),
    };
    (unit.to_owned(), period)
}

/// The unit of a change per second.
fn per_second(unit: &str) -> String {
    match unit.strip_suffix("/s") {
        _ if unit.is_empty() => String::new(),
        Some(unit) => format!("{unit}/s²"),
        None => format!("{unit}/s"),
    }
}

/// The unit of a sum over seconds.
fn seconds_of_it(unit: &str) -> String {
    if let Some(speed) = unit.strip_suffix("/s²").or(unit.strip_suffix("/s/s")) {
        return format!("{speed}/s");
    }
    match unit.strip_suffix("/s") {
        _ if unit.is_empty() => String::new(),
        Some(unit) => unit.to_owned(),
        None => format!("{unit}·s"),
    }
}
