//! Damages files, for tests.

/// Call a reader with so many damaged copies of each sample, the same for the same seed.
pub(super) fn all(samples: &[Vec<u8>], times: usize, seed: u64, read: impl Fn(&[u8])) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64 ^ (seed << 32);
    let mut random = move |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below.max(1) as u64) as usize
    };
    for sample in samples {
        for _ in 0..times {
            let mut bytes = sample.clone();
            for _ in 0..=random(3) {
                mutate(&mut bytes, &mut random);
            }
            read(&bytes);
        }
    }
}

fn mutate(bytes: &mut Vec<u8>, random: &mut impl FnMut(usize) -> usize) {
    let at = random(bytes.len());
    match random(5) {
        0 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << random(8);
            }
        }
        1 => bytes.truncate(at),
        2 => {
            let end = (at + random(40)).min(bytes.len());
            let piece = bytes[at..end].to_vec();
            let to = random(bytes.len());
            bytes.splice(to..to, piece);
        }
        3 => {
            let end = (at + random(20)).min(bytes.len());
            bytes.drain(at..end);
        }
        _ => {
            let numbers = [
                "1e999",
                "-1",
                "4294967296",
                "99999999999999999999",
                "nan",
                "0",
                "1e-320",
            ];
            let number = numbers[random(numbers.len())];
            let digit = bytes.iter().skip(at).position(u8::is_ascii_digit);
            let at = digit.map_or(at, |it| at + it);
            bytes.splice(at..(at + 1).min(bytes.len()), number.bytes());
        }
    }
}
