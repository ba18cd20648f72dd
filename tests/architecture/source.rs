//! Reading sources: their files, their code without comments, strings and tests, and its words.

use std::fs;
use std::path::Path;

/// A source file: its path below the folder that was read, with forward slashes, and its text.
pub struct Source {
    pub path: String,
    pub text: String,
}

impl Source {
    /// Read the sources of the library and the program.
    pub fn all() -> Vec<Self> {
        Self::below("src")
    }

    /// Read the sources below a folder of the package, in the order of their paths.
    pub fn below(folder: &str) -> Vec<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let mut folders = vec![root.clone()];
        let mut sources = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).expect("a readable folder") {
                let path = entry.expect("a readable entry").path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "rs") {
                    let below = path.strip_prefix(&root).expect("a path below the root");
                    let parts = below.iter().map(|part| part.to_string_lossy());
                    sources.push(Self {
                        path: parts.collect::<Vec<_>>().join("/"),
                        text: fs::read_to_string(&path).expect("a readable source"),
                    });
                }
            }
        }
        assert!(!sources.is_empty(), "{folder} holds no sources");
        sources.sort_by(|a, b| a.path.cmp(&b.path));
        sources
    }

    /// The names of the modules from the root to the file's own: `io/dxf/mod.rs` and `io/dxf.rs`
    /// are both `io`, `dxf`; `lib.rs` and `main.rs` are the root.
    pub fn module(&self) -> Vec<String> {
        let path = self.path.trim_end_matches(".rs");
        let mut names: Vec<String> = path.split('/').map(str::to_owned).collect();
        let roots: &[&str] = if names.len() == 1 {
            &["lib", "main"]
        } else {
            &["mod"]
        };
        if names
            .last()
            .is_some_and(|last| roots.contains(&last.as_str()))
        {
            names.pop();
        }
        names
    }
}

/// Blank comments and the insides of literals, so that only code is left; lines stay where they
/// are.
pub fn code(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (skipped, kept) = if rest.starts_with("//") {
            (rest.find('\n').unwrap_or(rest.len()), "")
        } else if rest.starts_with("/*") {
            (rest.find("*/").map_or(rest.len(), |end| end + 2), "")
        } else if first == '"' {
            (string_length(rest), "\"\"")
        } else if let Some(hashes) = raw_string_hashes(rest) {
            let close = format!("\"{}", "#".repeat(hashes));
            let open = hashes + 2;
            let end = rest[open..].find(&close);
            (
                end.map_or(rest.len(), |end| open + end + close.len()),
                "\"\"",
            )
        } else if let Some(length) = character_length(rest) {
            (length, "''")
        } else {
            code.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        code.push_str(kept);
        code.extend(rest[..skipped].chars().filter(|c| *c == '\n'));
        rest = &rest[skipped..];
    }
    code
}

fn string_length(text: &str) -> usize {
    let mut escaped = false;
    for (index, character) in text.char_indices().skip(1) {
        match character {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return index + 1,
            _ => {}
        }
    }
    text.len()
}

fn raw_string_hashes(text: &str) -> Option<usize> {
    let after = text.strip_prefix('r')?;
    let hashes = after.len() - after.trim_start_matches('#').len();
    after[hashes..].starts_with('"').then_some(hashes)
}

/// The length of a character literal; a quotation mark that begins a lifetime begins none.
fn character_length(text: &str) -> Option<usize> {
    let inside = text.strip_prefix('\'')?;
    let first = inside.chars().next()?;
    let length = match inside.strip_prefix('\\') {
        Some(escaped) => 2 + escaped.get(1..)?.find('\'')?,
        None => first.len_utf8(),
    };
    inside[length..].starts_with('\'').then_some(length + 2)
}

/// What marks an item that only tests see.
const TEST: &str = "#[cfg(test)]";

/// Blank the items of [code](code) that only tests see; lines stay where they are. Also lists the
/// modules among them that have files of their own.
pub fn without_tests(code: &str) -> (String, Vec<String>) {
    let mut kept = String::with_capacity(code.len());
    let mut modules = Vec::new();
    let mut rest = code;
    while let Some(start) = rest.find(TEST) {
        let (before, from) = rest.split_at(start);
        let (item, after) = from.split_at(TEST.len() + item_length(&from[TEST.len()..]));
        kept.push_str(before);
        kept.extend(item.chars().filter(|c| *c == '\n'));
        let words = tokens(item);
        if let [.., "mod", name, ";"] = words[..] {
            modules.push(name.to_owned());
        }
        rest = after;
    }
    kept.push_str(rest);
    (kept, modules)
}

/// The length of an item: up to the end of its first braces, or a semicolon before them.
fn item_length(code: &str) -> usize {
    let mut depth = 0;
    for (index, character) in code.char_indices() {
        match character {
            '{' | '(' | '[' => depth += 1,
            '}' | ')' | ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 && matches!(character, '}' | ';') {
            return index + 1;
        }
    }
    code.len()
}

fn is_word(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// Split code into words and single other characters, without spaces.
pub fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

#[test]
fn comments_literals_and_tests_are_no_code() {
    let text = "fn a() { f('{', '\\'', '\\u{7d}', \"}\") } // }\n\
                #[cfg(test)]\nmod tests {\n    fn b<'a>() {}\n}\n\
                #[cfg(test)]\n#[path = \"x.rs\"]\nmod cases;\nfn c<'a>(x: &'a str) {}\n";
    let (code, modules) = without_tests(&code(text));
    assert_eq!(
        code,
        "fn a() { f('', '', '', \"\") } \n\n\n\n\n\n\n\nfn c<'a>(x: &'a str) {}\n"
    );
    assert_eq!(modules, ["cases"]);
}
