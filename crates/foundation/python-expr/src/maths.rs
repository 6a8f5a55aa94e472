//! Functions of Python 3.11's `math`.
//!
//! Python calls the platform's C library, and Rust's standard library does the same for most functions, so
//! the last digits agree. If Rust has its own implementation or none, the `libm` crate is used, which
//! descends from the same Sun sources as the C libraries. `cbrt`, `gamma` and `lgamma` may still differ
//! from Python's in the last digit (glibc's `cbrt` is the less exact one; Python has its own `gamma`).

mod whole;

use super::callable::{Arguments, Builtin, Callable};
use super::error::{ExpressionError, Outcome, fail};
use super::interpreter::Interpreter;
use super::number::{Number, truncate};
use super::value::Value;

pub(super) use whole::INTEGERS;

const CONSTANTS: &[(&str, f64)] = &[
    ("pi", std::f64::consts::PI),
    ("e", std::f64::consts::E),
    ("tau", std::f64::consts::TAU),
    ("inf", f64::INFINITY),
    ("nan", f64::NAN),
];

/// Function of one real number.
macro_rules! real {
    ($name:literal, $function:expr) => {
        Builtin {
            name: $name,
            is_type: false,
            call: |_, arguments| one_real($name, arguments, $function),
        }
    };
}

/// Predicate of one real number.
macro_rules! test {
    ($name:literal, $function:expr) => {
        Builtin {
            name: $name,
            is_type: false,
            call: |_, arguments| {
                let [value] = arguments.exactly($name)?;
                let function: fn(f64) -> bool = $function;
                Ok(Value::Bool(function(value.real()?)))
            },
        }
    };
}

/// Function of two real numbers.
macro_rules! two_reals {
    ($name:literal, $function:expr) => {
        Builtin {
            name: $name,
            is_type: false,
            call: |_, arguments| two_reals($name, arguments, $function),
        }
    };
}

static REALS: &[Builtin] = &[
    real!("acos", pxfm::f_acos),
    real!("acosh", libm::acosh),
    real!("asin", pxfm::f_asin),
    real!("asinh", libm::asinh),
    real!("atan", pxfm::f_atan),
    real!("atanh", libm::atanh),
    real!("cbrt", libm::cbrt),
    real!("cos", pxfm::f_cos),
    real!("cosh", cosh),
    real!("degrees", |angle| angle * (180.0 / std::f64::consts::PI)),
    real!("erf", libm::erf),
    real!("erfc", libm::erfc),
    real!("exp", pxfm::f_exp),
    real!("exp2", libm::exp2),
    real!("expm1", libm::expm1),
    real!("fabs", f64::abs),
    real!("gamma", |x| if x == x.floor() && (x <= 0.0) { f64::NAN } else { libm::tgamma(x) }),
    real!("lgamma", |x| if x == x.floor() && (x <= 0.0) && x.is_finite() {
        f64::NAN
    } else {
        libm::lgamma(x)
    }),
    real!("log10", |x| if x == 0.0 { f64::NAN } else { libm::log10(x) }),
    real!("log1p", libm::log1p),
    real!("log2", |x| if x == 0.0 { f64::NAN } else { pxfm::f_log2(x) }),
    real!("radians", |angle| angle * (std::f64::consts::PI / 180.0)),
    real!("sin", pxfm::f_sin),
    real!("sinh", libm::sinh),
    real!("sqrt", f64::sqrt),
    real!("tan", pxfm::f_tan),
    real!("tanh", libm::tanh),
    real!("ulp", ulp),
    test!("isfinite", f64::is_finite),
    test!("isinf", f64::is_infinite),
    test!("isnan", f64::is_nan),
    two_reals!("atan2", pxfm::f_atan2),
    two_reals!("copysign", f64::copysign),
    two_reals!("fmod", |a, b| a % b),
    two_reals!("nextafter", libm::nextafter),
    two_reals!("remainder", libm::remainder),
    Builtin { name: "pow", is_type: false, call: pow },
    Builtin { name: "log", is_type: false, call: log },
    Builtin { name: "hypot", is_type: false, call: hypot },
    Builtin { name: "dist", is_type: false, call: dist },
    Builtin { name: "fsum", is_type: false, call: fsum },
    Builtin { name: "frexp", is_type: false, call: frexp },
    Builtin { name: "ldexp", is_type: false, call: ldexp },
    Builtin { name: "modf", is_type: false, call: modf },
    Builtin { name: "isclose", is_type: false, call: isclose },
    Builtin {
        name: "floor",
        is_type: false,
        call: |_, arguments| rounded("floor", arguments, f64::floor),
    },
    Builtin {
        name: "ceil",
        is_type: false,
        call: |_, arguments| rounded("ceil", arguments, f64::ceil),
    },
    Builtin {
        name: "trunc",
        is_type: false,
        call: |_, arguments| rounded("trunc", arguments, f64::trunc),
    },
];

/// Member of `math`.
pub(super) fn member(name: &str) -> Option<Value> {
    let constant = CONSTANTS
        .iter()
        .find(|(constant, _)| *constant == name)
        .map(|(_, value)| Value::Float(*value));
    let function = || [REALS, INTEGERS].into_iter().flatten().find(|builtin| builtin.name == name);
    constant.or_else(|| function().map(|builtin| Value::Function(Callable::Builtin(builtin))))
}

/// All members of `math`.
pub(super) fn names() -> Vec<&'static str> {
    let functions = [REALS, INTEGERS].into_iter().flatten().map(|builtin| builtin.name);
    CONSTANTS.iter().map(|(name, _)| *name).chain(functions).collect()
}

fn one_real(name: &str, arguments: Arguments, function: fn(f64) -> f64) -> Outcome<Value> {
    let [value] = arguments.exactly(name)?;
    let x = value.real()?;
    checked(name, function(x), !x.is_nan(), x.is_finite())
}

fn two_reals(name: &str, arguments: Arguments, function: fn(f64, f64) -> f64) -> Outcome<Value> {
    let [a, b] = arguments.exactly(name)?;
    let (a, b) = (a.real()?, b.real()?);
    checked(
        name,
        function(a, b),
        !a.is_nan() && !b.is_nan(),
        a.is_finite() && b.is_finite() && name != "nextafter",
    )
}

/// Python raises an error where C returns NaN or infinity.
fn checked(name: &str, result: f64, were_numbers: bool, were_finite: bool) -> Outcome<Value> {
    if result.is_nan() && were_numbers {
        Err(outside(name))
    } else if result.is_infinite() && were_finite {
        fail(format!("the result of `{name}` is too large for a float"))
    } else {
        Ok(Value::Float(result))
    }
}

fn outside(name: &str) -> ExpressionError {
    let error = ExpressionError::new(format!("`{name}` is not defined for this value"));
    match name {
        "acos" | "asin" => error.with_help("the value must lie between -1 and 1"),
        "sqrt" => error.with_help("the value must not be negative"),
        "log" | "log2" | "log10" => error.with_help("the value must be positive"),
        _ => error,
    }
}

/// Hyperbolic cosine, from the exponential as the C library of Linux has it.
fn cosh(x: f64) -> f64 {
    let x = x.abs();
    if x < 0.5 * std::f64::consts::LN_2 {
        let above_one = libm::expm1(x);
        return 1.0 + above_one * above_one / (2.0 * (1.0 + above_one));
    }
    let half = 0.5 * pxfm::f_exp(x);
    if half.is_finite() { half + 0.25 / half } else { libm::cosh(x) }
}

/// Power with the special cases of C99: anything to the power of 0, and 1 to any power, is 1.
pub(crate) fn powf(base: f64, exponent: f64) -> f64 {
    if base == 1.0 || exponent == 0.0 { 1.0 } else { pxfm::f_pow(base, exponent) }
}

fn ulp(x: f64) -> f64 {
    if !x.is_finite() {
        return x.abs();
    }
    let x = x.abs();
    if x == f64::MAX { x - x.next_down() } else { x.next_up() - x }
}

fn pow(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [base, exponent] = arguments.exactly("pow")?;
    let (base, exponent) = (base.real()?, exponent.real()?);
    let result = powf(base, exponent);
    if base == 0.0 && exponent < 0.0 && exponent.is_finite() {
        return Err(outside("pow"));
    }
    checked(
        "pow",
        result,
        !base.is_nan() && !exponent.is_nan(),
        base.is_finite() && exponent.is_finite(),
    )
}

fn log(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let values = arguments.all("log")?;
    let natural = |value: &Value| -> Outcome<f64> {
        let x = value.real()?;
        if x <= 0.0 { Err(outside("log")) } else { Ok(pxfm::f_log(x)) }
    };
    match values.as_slice() {
        [x] => natural(x).map(Value::Float),
        [x, base] => {
            let (x, base) = (natural(x)?, natural(base)?);
            if base == 0.0 {
                fail("division by zero: the logarithm has no base 1")
            } else {
                Ok(Value::Float(x / base))
            }
        }
        _ => fail(format!("`log` takes 1 to 2 arguments, not {}", values.len())),
    }
}

fn reals(values: &[Value]) -> Outcome<Vec<f64>> {
    values.iter().map(Value::real).collect()
}

fn hypot(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let values = reals(&arguments.all("hypot")?)?;
    let norm = norm(&values);
    checked(
        "hypot",
        norm,
        values.iter().all(|value| !value.is_nan()),
        values.iter().all(|value| value.is_finite()),
    )
}

fn dist(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [p, q] = arguments.exactly("dist")?;
    let (p, q) = (interpreter.collect(&p)?, interpreter.collect(&q)?);
    let (p, q) = (reals(&p)?, reals(&q)?);
    if p.len() != q.len() {
        return fail("the points of `dist` have different numbers of coordinates");
    }
    let differences: Vec<f64> = p.iter().zip(&q).map(|(p, q)| p - q).collect();
    Ok(Value::Float(norm(&differences)))
}

/// Euclidean norm with the precision of Python since 3.10: squares summed in double-double precision, then
/// one step of Newton's method on the root.
fn norm(values: &[f64]) -> f64 {
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if values.iter().any(|value| value.is_infinite()) {
        return f64::INFINITY;
    }
    if values.iter().any(|value| value.is_nan()) {
        return f64::NAN;
    }
    if largest == 0.0 {
        return 0.0;
    }
    // A power of two, so that scaling is exact and no square overflows or underflows.
    let (_, exponent) = libm::frexp(largest);
    let mut high = 0.0_f64;
    let mut low = 0.0_f64;
    for value in values {
        let scaled = libm::ldexp(*value, -exponent);
        let square = scaled * scaled;
        let square_error = scaled.mul_add(scaled, -square);
        let sum = high + square;
        let sum_error = if high >= square { (high - sum) + square } else { (square - sum) + high };
        high = sum;
        low += sum_error + square_error;
    }
    let root = (high + low).sqrt();
    let rest = (-root).mul_add(root, high) + low;
    libm::ldexp(root + rest / (2.0 * root), exponent)
}

/// Exactly rounded sum (J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic", 1997):
/// non-overlapping partial sums, smallest first.
fn fsum(interpreter: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [values] = arguments.exactly("fsum")?;
    let values = interpreter.collect(&values)?;
    let mut partials: Vec<f64> = Vec::new();
    let mut special = 0.0;
    for value in &values {
        let mut x = value.real()?;
        if !x.is_finite() {
            special += x;
            continue;
        }
        let mut kept = 0;
        for index in 0..partials.len() {
            let mut y = partials[index];
            if x.abs() < y.abs() {
                std::mem::swap(&mut x, &mut y);
            }
            let high = x + y;
            let low = y - (high - x);
            if low != 0.0 {
                partials[kept] = low;
                kept += 1;
            }
            x = high;
        }
        if x.is_infinite() {
            return fail("the sum is too large for a float");
        }
        partials.truncate(kept);
        partials.push(x);
    }
    if special != 0.0 {
        return checked(
            "fsum",
            special,
            values.iter().all(|value| value.real().is_ok_and(|value| !value.is_nan())),
            false,
        );
    }
    let mut high = partials.pop().unwrap_or(0.0);
    while let Some(next) = partials.pop() {
        let before = high;
        high = before + next;
        let low = next - (high - before);
        if low != 0.0 {
            // Halfway between two floats: the remaining part decides.
            if partials.last().is_some_and(|below| (*below < 0.0) == (low < 0.0) && *below != 0.0) {
                let doubled = low * 2.0;
                let rounded = high + doubled;
                if doubled == rounded - high {
                    high = rounded;
                }
            }
            break;
        }
    }
    Ok(Value::Float(high))
}

fn frexp(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("frexp")?;
    let x = value.real()?;
    let (mantissa, exponent) = if x.is_finite() { libm::frexp(x) } else { (x, 0) };
    Value::tuple(vec![Value::Float(mantissa), Value::Int(i128::from(exponent))])
}

fn ldexp(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [mantissa, exponent] = arguments.exactly("ldexp")?;
    let mantissa = mantissa.real()?;
    // Beyond this every finite float overflows or underflows.
    let exponent = exponent.integer()?.clamp(-10_000, 10_000) as i32;
    checked("ldexp", libm::ldexp(mantissa, exponent), true, mantissa.is_finite())
        .or_else(|error| if mantissa.is_nan() { Ok(Value::Float(mantissa)) } else { Err(error) })
}

fn modf(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("modf")?;
    let x = value.real()?;
    let fraction = if x.is_infinite() { 0.0_f64.copysign(x) } else { x.fract().copysign(x) };
    Value::tuple(vec![Value::Float(fraction), Value::Float(x.trunc())])
}

fn isclose(_: &mut Interpreter<'_>, mut arguments: Arguments) -> Outcome<Value> {
    let relative = arguments.keyword("rel_tol").map_or(Ok(1e-9), |value| value.real())?;
    let absolute = arguments.keyword("abs_tol").map_or(Ok(0.0), |value| value.real())?;
    let [a, b] = arguments.exactly("isclose")?;
    if relative < 0.0 || absolute < 0.0 {
        return fail("the tolerances of `isclose` must not be negative");
    }
    let (a, b) = (a.real()?, b.real()?);
    let difference = (a - b).abs();
    let is_close = a == b
        || (a.is_finite()
            && b.is_finite()
            && (difference <= relative * a.abs().max(b.abs()) || difference <= absolute));
    Ok(Value::Bool(is_close))
}

fn rounded(name: &str, arguments: Arguments, round: fn(f64) -> f64) -> Outcome<Value> {
    let [value] = arguments.exactly(name)?;
    match value.number() {
        Some(Number::Int(int)) => Ok(Value::Int(int)),
        Some(Number::Float(float)) => truncate(round(float)).map(Value::Int),
        None => fail(format!("`{name}` needs a number, not `{}`", value.type_name())),
    }
}
