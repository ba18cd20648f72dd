//! Properties whose cases can be repeated.

use proptest::test_runner::{Config, RngSeed};

/// The seed of every property's cases, unless `PROPTEST_RNG_SEED` names another.
const SEED: u64 = 20;

/// Configure properties so that every run draws the same cases. `PROPTEST_RNG_SEED` and
/// `PROPTEST_CASES` ask for others and for more; a test that fails prints how to repeat it.
pub fn repeatable() -> Config {
    let mut config = Config::default();
    if config.rng_seed == RngSeed::Random {
        config.rng_seed = RngSeed::Fixed(SEED);
    }
    // The seed repeats a failure: no file of failures is needed beside the sources.
    config.failure_persistence = None;
    println!("To repeat: {}", command(&config));
    config
}

/// The command that runs the test of this thread on the same cases.
fn command(config: &Config) -> String {
    let seed = format!("PROPTEST_RNG_SEED={}", config.rng_seed);
    let cases = std::env::var("PROPTEST_CASES").map(|cases| format!("PROPTEST_CASES={cases}"));
    let target = match env!("CARGO_CRATE_NAME") {
        "batten" => "--lib".to_owned(),
        binary => format!("--test {binary}"),
    };
    let thread = std::thread::current();
    // With one thread alone the tests run on the main one, which bears no test's name.
    let test = thread.name().filter(|name| *name != "main");
    let words = [
        Some(seed),
        cases.ok(),
        Some(format!("cargo test {target}")),
        test.map(str::to_owned),
    ];
    words.into_iter().flatten().collect::<Vec<_>>().join(" ")
}
