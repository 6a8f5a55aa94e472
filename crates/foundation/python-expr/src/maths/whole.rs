//! Functions of `math` on integers.

use super::super::ast::Binary;
use super::super::callable::{Arguments, Builtin};
use super::super::error::{ExpressionError, Outcome, fail};
use super::super::interpreter::Interpreter;
use super::super::number::too_large;
use super::super::operators::binary;
use super::super::value::Value;

pub(in super::super) static INTEGERS: &[Builtin] = &[
    Builtin { name: "factorial", is_type: false, call: factorial },
    Builtin { name: "comb", is_type: false, call: comb },
    Builtin { name: "perm", is_type: false, call: perm },
    Builtin { name: "gcd", is_type: false, call: gcd },
    Builtin { name: "lcm", is_type: false, call: lcm },
    Builtin { name: "isqrt", is_type: false, call: isqrt },
    Builtin { name: "prod", is_type: false, call: prod },
];

fn not_negative(value: &Value, function: &str) -> Outcome<i128> {
    match value.integer()? {
        int if int < 0 => {
            Err(ExpressionError::new(format!("`{function}` is not defined for negative numbers")))
        }
        int => Ok(int),
    }
}

/// `from * (from - 1) * ...`, `count` factors. Ends early: the products soon exceed 128 bits, and `count`
/// is at most `from`.
fn falling(from: i128, count: i128) -> Outcome<i128> {
    let mut product: i128 = 1;
    for index in 0..count {
        product = product.checked_mul(from - index).ok_or_else(too_large)?;
    }
    Ok(product)
}

fn factorial(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("factorial")?;
    let n = not_negative(&value, "factorial")?;
    falling(n, n).map(Value::Int)
}

fn perm(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [n, k] = arguments.bind("perm", ["n", "k"], 1)?;
    let n = not_negative(&n.unwrap_or(Value::None), "perm")?;
    let k = match k {
        None | Some(Value::None) => n,
        Some(k) => not_negative(&k, "perm")?,
    };
    if k > n { Ok(Value::Int(0)) } else { falling(n, k).map(Value::Int) }
}

fn comb(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [n, k] = arguments.exactly("comb")?;
    let (n, k) = (not_negative(&n, "comb")?, not_negative(&k, "comb")?);
    if k > n {
        return Ok(Value::Int(0));
    }
    let mut result: i128 = 1;
    // Each step at least doubles the result while index <= n / 2, so at most 128 steps are needed.
    for index in 0..k.min(n - k) {
        let (numerator, denominator) = (n - index, index + 1);
        let shared = greatest_divisor(result, denominator);
        let (result_part, denominator) = (result / shared, denominator / shared);
        result = result_part.checked_mul(numerator / denominator).ok_or_else(too_large)?;
    }
    Ok(Value::Int(result))
}

fn greatest_divisor(mut a: i128, mut b: i128) -> i128 {
    while b != 0 {
        (a, b) = (b, a.wrapping_rem(b));
    }
    a.wrapping_abs()
}

fn gcd(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let mut result = 0;
    for value in arguments.all("gcd")? {
        result = greatest_divisor(result, value.integer()?);
    }
    if result < 0 { Err(too_large()) } else { Ok(Value::Int(result)) }
}

fn lcm(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let mut result: i128 = 1;
    for value in arguments.all("lcm")? {
        let int = value.integer()?;
        if int == 0 || result == 0 {
            result = 0;
            continue;
        }
        let reduced = result / greatest_divisor(result, int);
        result = reduced.checked_mul(int).and_then(i128::checked_abs).ok_or_else(too_large)?;
    }
    Ok(Value::Int(result))
}

fn isqrt(_: &mut Interpreter<'_>, arguments: Arguments) -> Outcome<Value> {
    let [value] = arguments.exactly("isqrt")?;
    not_negative(&value, "isqrt").map(|int| Value::Int(int.isqrt()))
}

fn prod(interpreter: &mut Interpreter<'_>, mut arguments: Arguments) -> Outcome<Value> {
    let mut product = arguments.keyword("start").unwrap_or(Value::Int(1));
    let [values] = arguments.exactly("prod")?;
    let iterator = interpreter.iterate(&values)?;
    while let Some(value) = interpreter.next(&iterator)? {
        if value.number().is_none() {
            return fail(format!("`prod` needs numbers, not `{}`", value.type_name()));
        }
        product = binary(Binary::Multiply, &product, &value, interpreter.budget)?;
    }
    Ok(product)
}
