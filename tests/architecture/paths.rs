//! The paths that code names: in its imports, and anywhere else.

/// A path as code names it.
#[derive(Debug, PartialEq)]
pub struct NamedPath {
    /// Its names, as they are written.
    pub names: Vec<String>,
    /// The modules inside the file in which it stands.
    pub inside: Vec<String>,
    /// The import that names it, if one does.
    pub import: Option<Import>,
}

/// How an import brings in a name.
#[derive(Debug, PartialEq)]
pub struct Import {
    /// The name that the file gives it; `*` for all names of a module.
    pub name: String,
    /// Whether others see it there too.
    pub is_public: bool,
}

impl NamedPath {
    /// The names from the root of the crate, if the path says so itself: it begins with `crate`,
    /// `batten`, `self` or `super`. `module` is the file's own.
    pub fn absolute(&self, module: &[String]) -> Option<Vec<String>> {
        let mut names = self.names.as_slice();
        let mut start = [module, &self.inside].concat();
        match names.first().map(String::as_str) {
            Some("crate" | "batten") => {
                start.clear();
                names = &names[1..];
            }
            Some("self") => names = &names[1..],
            Some("super") => {}
            _ => return None,
        }
        while names.first().is_some_and(|name| name == "super") {
            start.pop();
            names = &names[1..];
        }
        start.extend_from_slice(names);
        Some(start)
    }
}

/// List the paths of at least two names, and all imports.
pub fn named_paths(tokens: &[&str]) -> Vec<NamedPath> {
    let mut paths = Vec::new();
    let mut depth = 0;
    // The modules inside the file, with the depth of their braces.
    let mut open: Vec<(String, usize)> = Vec::new();
    let mut at = 0;
    while let Some(&token) = tokens.get(at) {
        let inside = || open.iter().map(|(name, _)| name.clone()).collect();
        let before = |count: usize| at.checked_sub(count).map_or("", |at| tokens[at]);
        match token {
            "{" => {
                depth += 1;
                if before(2) == "mod" {
                    open.push((before(1).to_owned(), depth));
                }
            }
            "}" => {
                open.pop_if(|(_, inner)| *inner == depth);
                depth = depth.saturating_sub(1);
            }
            // Not that of `impl Trait + use<'a>`.
            "use" if tokens.get(at + 1) != Some(&"<") => {
                let is_public = matches!(before(1), "pub" | ")");
                let mut found = Vec::new();
                at += 1 + imports(&tokens[at + 1..], &[], &mut found);
                paths.extend(found.into_iter().map(|(names, name)| NamedPath {
                    names,
                    inside: inside(),
                    import: Some(Import { name, is_public }),
                }));
                continue;
            }
            _ if is_name(token) && [before(2), before(1)] != [":", ":"] => {
                let length = path_length(&tokens[at..]);
                // What may see an item is no use of it: `pub(in crate::editor)`.
                let is_visibility = [before(3), before(2), before(1)] == ["pub", "(", "in"];
                if length > 1 && !is_visibility {
                    let names = tokens[at..].iter().step_by(3).take(length);
                    paths.push(NamedPath {
                        names: names.map(ToString::to_string).collect(),
                        inside: inside(),
                        import: None,
                    });
                }
                at += 3 * (length - 1);
            }
            _ => {}
        }
        at += 1;
    }
    paths
}

fn is_name(token: &str) -> bool {
    token.starts_with(|first: char| first.is_alphabetic() || first == '_')
}

/// Count the names of the path that tokens begin with.
fn path_length(tokens: &[&str]) -> usize {
    let more = tokens[1..].chunks(3);
    1 + more
        .take_while(|chunk| matches!(chunk, [":", ":", name] if is_name(name)))
        .count()
}

/// List what a tree of imports brings in, each with its whole path and the name it gets; returns
/// how many tokens the tree has.
fn imports(tokens: &[&str], outer: &[String], found: &mut Vec<(Vec<String>, String)>) -> usize {
    let mut path = outer.to_vec();
    let mut name = String::new();
    let mut at = 0;
    while let Some(&token) = tokens.get(at) {
        at += 1;
        match token {
            "{" => {
                while !matches!(tokens.get(at), Some(&"}") | None) {
                    at += imports(&tokens[at..], &path, found);
                    at += usize::from(tokens.get(at) == Some(&","));
                }
                at += 1;
                name.clear();
            }
            ":" => {}
            "as" => {
                name = tokens.get(at).copied().unwrap_or_default().to_owned();
                at += 1;
            }
            "*" => name = "*".to_owned(),
            "," | "}" | ";" => {
                at -= 1;
                break;
            }
            // In braces: the module itself.
            "self" if !outer.is_empty() => name = path.last().cloned().unwrap_or_default(),
            _ => {
                path.push(token.to_owned());
                name = token.to_owned();
            }
        }
    }
    if !name.is_empty() {
        found.push((path, name));
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::tokens;

    fn check(code: &str, expected: &[&str]) {
        let module = ["io".to_owned(), "dxf".to_owned()];
        let paths = named_paths(&tokens(code));
        let found: Vec<String> = paths
            .iter()
            .map(|path| match (path.absolute(&module), &path.import) {
                (Some(names), None) => format!("/{}", names.join("/")),
                (Some(names), Some(import)) => format!("/{} {}", names.join("/"), import.name),
                (None, _) => path.names.join("/"),
            })
            .collect();
        assert_eq!(found, expected, "{code}");
    }

    #[test]
    fn imports_are_listed_one_by_one() {
        check("use crate::io::Format;", &["/io/Format Format"]);
        check(
            "use super::{error::{self, Place as Where}, *}; use std::fmt;",
            &[
                "/io/error error",
                "/io/error/Place Where",
                "/io *",
                "std/fmt",
            ],
        );
        check("pub use crate::geometry;", &["/geometry geometry"]);
        let public = |code| {
            named_paths(&tokens(code))
                .remove(0)
                .import
                .unwrap()
                .is_public
        };
        assert!(public("pub(super) use frame::Layer;"));
        assert!(!public("use frame::Layer;"));
    }

    #[test]
    fn paths_in_code_are_listed() {
        check(
            "fn f(x: super::Format) -> frame::Layer { self::g::<u8>(&crate::io::LIST[0]) }",
            &["/io/Format", "frame/Layer", "/io/dxf/g", "/io/LIST"],
        );
        check("pub(in crate::io) fn f() -> u8 { 0 }", &[]);
        check("for x in crate::io::all() {}", &["/io/all"]);
        check(
            "mod tests { use super::super::Format; } fn f() { super::super::a::b() }",
            &["/io/Format Format", "/a/b"],
        );
    }
}
