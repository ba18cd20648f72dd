//! References as text: what is read, what is written, and mistakes with their columns.

use batten::geometry::references::{KINDS, ReferenceCurve, ReferenceError, ReferenceForm};

fn read(text: &str) -> ReferenceCurve {
    ReferenceCurve::from_text(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn values(curve: &ReferenceCurve) -> &[f64] {
    match curve.form() {
        ReferenceForm::Analytic(form) => form.values(),
        other => panic!("{other:?} has no values"),
    }
}

#[test]
fn what_is_not_given_has_its_default() {
    for kind in KINDS {
        let curve = read(kind.name);
        assert_eq!(values(&curve), kind.defaults());
        assert_eq!(curve.interval(), curve.form().default_interval());
        assert_eq!(curve.form().label(), kind.label);
    }
}

#[test]
fn values_and_the_interval_are_read() {
    let curve = read(" log-aesthetic : lambda = 0.25, alpha=-2 ,to=1.5,from=-1e-1");
    assert_eq!(values(&curve), [-2.0, 0.25]);
    assert_eq!(curve.interval(), [-0.1, 1.5]);
}

#[test]
fn what_is_written_is_read_back_to_the_bit() {
    for text in [
        "circle:radius=0.1",
        "clothoid:a=3.3333333333333335,from=-2,to=1e-300",
        "log-aesthetic:alpha=-1,lambda=0.5,to=0.30000000000000004",
        "conical-spiral:rise=-7",
        "formula:x=cos(2*t)/3;y= sin(t) ;from=-pi;to=2^0.5",
        "formula:x=t;y=-t^2;z=e^(-t)",
    ] {
        let curve = read(text);
        assert_eq!(read(&curve.to_string()), curve);
    }
}

/// Assert that a text is refused, at a column counted from 1, with these words.
#[track_caller]
fn assert_refused(text: &str, column: usize, words: &str) {
    let error = ReferenceCurve::from_text(text).expect_err("a mistake");
    assert_eq!(error.column, column, "{text}: {error}");
    let said = error.error.to_string();
    assert!(said.contains(words), "{text}: {said}");
}

#[test]
fn mistakes_name_their_columns() {
    assert_refused("", 1, "there is no reference “”");
    assert_refused("  circel", 3, "there is no reference “circel”");
    assert_refused("circle:", 8, "gives no parameter a value");
    assert_refused("circle:radius=2,", 17, "gives no parameter a value");
    assert_refused("circle:radius", 8, "“radius” gives no parameter a value");
    assert_refused(
        "circle: diameter=3",
        9,
        "circle has no parameter “diameter”",
    );
    assert_refused(
        "circle:radius= 2x",
        17,
        "“x” is no unit here: write deg or rad, or * to multiply",
    );
    assert_refused("circle:radius=inf", 15, "“inf” is too large");
    assert_refused("circle:radius=1/0", 15, "“1/0” divides by zero");
    assert_refused("circle:radius=2*t", 15, "“2*t” depends on t");
    assert_refused("circle:radius=-2", 15, "Radius: -2 is out of range");
    assert_refused("circle:radius=1,radius=2", 17, "“radius” is given twice");
    assert_refused("circle:größe=2", 8, "no parameter “größe”");
    assert_refused("circle:from=3,to=2", 1, "from t = 3 to t = 2 is empty");
}

#[test]
fn mistakes_in_formulas_name_their_columns() {
    let operand = "a number, t, a function or a parenthesis";
    assert_refused("formula:x=t", 1, "gives no y");
    assert_refused("formula:y=t", 1, "gives no x");
    assert_refused("formula", 1, "gives no x");
    assert_refused("formula:x=t;w=t", 13, "formula has no parameter “w”");
    assert_refused("formula:x=;y=t", 11, operand);
    assert_refused("formula:x=2*;y=t", 13, operand);
    assert_refused("formula:x=t;y=2*(t+1", 21, "a closing parenthesis");
    assert_refused(
        "formula:x=t;y=t)",
        16,
        "expected an operator or the end, found “)”",
    );
    assert_refused("formula:x=t;y=2 t", 17, "“t” is no unit here");
    assert_refused("formula:x=t;y=2mm", 16, "“mm” is no unit here");
    assert_refused(
        "formula:x=t;y=2 sin(t)",
        17,
        "expected an operator or the end, found “s”",
    );
    assert_refused("formula:x=t;y=min(t)", 15, "min needs two arguments");
    assert_refused("formula:x=t;y=3+sinn(t)", 17, "“sinn” means nothing here");
    assert_refused("formula:x=t;y=3·u", 17, "“u” means nothing here");
    assert_refused("formula:x=t;y=sin t", 15, "followed by a parenthesis, sin");
    for point in [
        "formula:x=1;y=2",
        "formula:x=t-t;y=2*pi",
        "formula:x=1;y=cos(t)^2+sin(t)^2",
    ] {
        assert_refused(
            point,
            1,
            "the formulas give one point, the same for every t",
        );
    }
    assert_refused("formula:x=t;y=1e999", 15, "“1e999” is too large");
    assert_refused(
        "formula:x=t;y=ln(t);from=-1;to=1",
        1,
        "no point, or no direction, at t = -1",
    );
    let deep = format!("formula:x=t;y={}t", "(".repeat(2000));
    assert_refused(&deep, 65, "too long");
    let long = format!("formula:x=t;y=t{}", "+t".repeat(2000));
    assert_refused(&long, 1015, "too long");
}

#[test]
fn expressions_bind_as_in_mathematics() {
    for (expression, value) in [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-2", 0.25),
        ("8/4/2", 1.0),
        ("8-4-2", 2.0),
        ("2+3*4", 14.0),
        ("-(2+3)*--4", -20.0),
        ("abs(-3)·sqrt(16) − .5e1", 7.0),
        ("cos(pi)+ln(e)+tan(π/4)", 1.0),
        ("+7", 7.0),
        ("sin(30deg) + 1/2deg/pi*180*2", 1.5),
        ("max(1, 2) + min(hypot(3, 4), 7)", 7.0),
        ("atan2(-1, -1) / (1deg)", -135.0),
    ] {
        let curve = read(&format!("conical-spiral:rise={expression}"));
        let found = values(&curve)[0];
        assert!((found - value).abs() <= 1e-14, "{expression} = {found}");
    }
}

#[test]
fn intervals_beyond_the_curve_are_refused() {
    let beyond = "log-aesthetic:alpha=-1,lambda=0.5,from=0,to=3";
    assert_refused(beyond, 1, "t can run from");
    assert_refused("clothoid:to=1000", 1, "t = 1000 is out of range");
}

#[test]
fn poles_of_formulas_are_noticed_wherever_they_are() {
    let gap = |x: &str, from: f64, to: f64| {
        let text = format!("formula:x={x};y=t;from={from};to={to}");
        let read = ReferenceCurve::from_text(&text).map_err(|mistake| mistake.error);
        match read.and_then(|curve| curve.check_points()) {
            Err(ReferenceError::NotFinite { t }) => t,
            other => panic!("{text}: {other:?}"),
        }
    };
    let pi = std::f64::consts::PI;
    for (x, from, to, place) in [
        ("1/(t-0.3)", 0.0, 1.0, 0.3),
        ("1/(t-1/3)", 0.0, 1.0, 1.0 / 3.0),
        ("1/(3*t-1)^2", -7.0, 11.0, 1.0 / 3.0),
        ("(t-0.123456)^(-2)", 0.0, 1.0, 0.123456),
        ("tan(t)", 1.0, 2.0, 0.5 * pi),
        ("1/sin(t)", 1.0, 5.0, pi),
        ("exp(1/(t^2-2))", 0.0, 2.0, 2.0_f64.sqrt()),
        ("ln(abs(t-0.7))", 0.0, 2.0, 0.7),
        ("1/min(t-0.7, 5)", 0.1, 2.0, 0.7),
        ("1/(atan2(t, 2)-pi/8)", 0.1, 2.0, 0.828_427_124_746_19),
        ("1/(sin(t)+t-2)", 0.0, 2.0, 1.106_060_157_706_271_9),
    ] {
        let found = gap(x, from, to);
        assert!(
            (found - place).abs() <= 1e-14 * place.abs().max(1.0),
            "{x}: {found}"
        );
    }
    // The first of several, of any coordinate.
    assert!((gap("1/sin(5*t)", 0.1, 3.0) - 0.2 * pi).abs() < 1e-14);
}

#[test]
fn formulas_without_poles_are_no_worse_for_the_search() {
    for x in [
        "1/(1+t^2)",
        "1/(1.0001-2*t+t^2)",
        "1/(1.1+sin(9*t)*cos(3*t))",
        "tan(t/2)",
        "sqrt(t+2)",
        "ln(t-0.39999)",
        "t^1.5+t",
        "asin(t/3)",
        "acos(cos(t+0.5)/2)",
        "exp(-1/(t^2+0.01))",
        "exp(300*t)*exp(-300*t)",
        "ln(2+sin(t))^3",
        "hypot(t, sin(t))*max(t, 1)",
        "1/(atan2(t+1, 1-t)+1)",
        "(t-0.3)^(-2)*0+1",
    ] {
        let text = format!("formula:x={x};y=t;from=0.4;to=2");
        let read = ReferenceCurve::from_text(&text).expect("a formula");
        assert_eq!(read.check_points(), Ok(()), "{text}");
    }
}

#[test]
fn only_the_interval_that_counts_is_checked() {
    let text = "formula:x=t;y=1/t";
    assert!(ReferenceCurve::from_text(text).is_err());
    let read = ReferenceCurve::from_text_over(text, [Some(1.0), Some(2.0)]);
    assert_eq!(read.expect("a curve").interval(), [1.0, 2.0]);
    let read = ReferenceCurve::from_text_over("circle:to=3", [Some(1.0), Some(2.0)]);
    assert_eq!(read.expect("a curve").interval(), [1.0, 3.0]);
}
