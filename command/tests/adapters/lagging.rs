//! Faulty program: an augmented Lagrangian method that reports the multiplier of the previous step as the
//! contact force.

use std::io::{BufRead, Write};

fn value<'a>(line: &'a str, key: &str) -> &'a str {
    let rest = &line[line.find(&format!("\"{key}\":")).unwrap() + key.len() + 3..];
    rest[..rest.find([',', '}']).unwrap()].trim()
}

fn main() {
    for line in std::io::stdin().lock().lines() {
        let line = line.unwrap();
        let number = |key| value(&line, key).parse::<f64>().unwrap();
        let (c, weight) = (number("stiffness"), number("mass") * number("gravity"));
        let gap = number("height") - number("free_length");
        let (eps, mut lambda, mut steps) = (5.0 * c, 0.0, Vec::new());
        for _ in 0..40 {
            let u = (weight / c).min((weight - lambda + eps * gap) / (c + eps));
            steps.push(format!("{{\"deflection\": {u:e}, \"contact_force\": {lambda:e}}}"));
            lambda = f64::max(0.0, lambda + eps * (u - gap));
        }
        let last = steps.last().unwrap().trim_start_matches('{').to_string();
        let id = value(&line, "id");
        println!("{{\"id\": {id}, \"steps\": [{}], {last}", steps.join(", "));
        std::io::stdout().flush().unwrap();
    }
}
