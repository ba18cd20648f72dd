//! Representations of shape, their units, and the products that they belong to.

use std::collections::HashMap;

use super::instances::{Instance, Instances};
use super::text::decode;
use super::tokens::{Params, Value};
use super::units::Units;

/// A representation that holds the shape of a product or of a part of it.
pub struct Representation<'a> {
    /// Its number.
    pub id: u64,
    /// Its items.
    pub items: Params<'a>,
    /// Its units.
    pub units: Units,
    /// Its name, raw.
    pub name: Option<&'a [u8]>,
    /// The PRODUCT_DEFINITION that it is the shape of.
    pub product: Option<u64>,
}

/// All representations of shape, in the order of the file.
pub struct Representations<'a> {
    /// In the order of the file.
    pub list: Vec<Representation<'a>>,
    /// Places in the list, by number.
    pub places: HashMap<u64, usize>,
    /// Representations of aspects and properties, left out: their items belong to other representations, or
    /// are no shape at all.
    pub properties: Vec<(String, u64)>,
}

impl<'a> Representations<'a> {
    /// Find all.
    pub fn read(file: &Instances<'a>) -> Self {
        let (products, properties) = definitions(file);
        let mut read = Self {
            list: Vec::new(),
            places: HashMap::new(),
            properties: Vec::new(),
        };
        let mut contexts: HashMap<u64, Units> = HashMap::new();
        for instance in file.all() {
            let Some((name, params)) = shape(&instance) else {
                continue;
            };
            if properties.contains_key(&instance.id) && !products.contains_key(&instance.id) {
                if name != "REPRESENTATION" {
                    read.properties.push((name.to_owned(), instance.line));
                }
                continue;
            }
            let [label, items, context] = params.first::<3>();
            let units = context.reference().map(|id| {
                *contexts
                    .entry(id)
                    .or_insert_with(|| Units::of_context(file, id))
            });
            read.places.entry(instance.id).or_insert(read.list.len());
            read.list.push(Representation {
                id: instance.id,
                items: items.list().unwrap_or_default(),
                units: units.unwrap_or_default(),
                name: match label {
                    Value::Text(text) => Some(text),
                    _ => None,
                },
                product: products.get(&instance.id).copied(),
            });
        }
        read
    }
}

/// Name a product by the number of its PRODUCT_DEFINITION.
pub fn product_name(file: &Instances, definition: u64) -> Option<String> {
    let [_, _, formation] = file.get(definition)?.params().first::<3>();
    let [_, _, product] = file.get(formation.reference()?)?.params().first::<3>();
    let product = file
        .get(product.reference()?)
        .filter(|it| it.is("PRODUCT"))?;
    let [id, name] = product.params().first::<2>();
    text(&name).or_else(|| text(&id))
}

/// Decode a text; none if it is blank.
pub fn text(value: &Value) -> Option<String> {
    match value {
        Value::Text(raw) => Some(decode(raw)).filter(|text| !text.trim().is_empty()),
        _ => None,
    }
}

/// The representations of products and those of anything else, each with its definition.
fn definitions(file: &Instances) -> (HashMap<u64, u64>, HashMap<u64, u64>) {
    let mut products = HashMap::new();
    let mut properties = HashMap::new();
    for link in file.all() {
        if !link.is("SHAPE_DEFINITION_REPRESENTATION")
            && !link.is("PROPERTY_DEFINITION_REPRESENTATION")
        {
            continue;
        }
        let [Value::Ref(definition), Value::Ref(representation)] = link.params().first::<2>()
        else {
            continue;
        };
        let shape = file
            .get(definition)
            .filter(|it| it.is("PRODUCT_DEFINITION_SHAPE"));
        match shape.map(|it| it.params().first::<3>()) {
            Some([_, _, Value::Ref(product)]) => products.entry(representation).or_insert(product),
            _ => properties.entry(representation).or_insert(definition),
        };
    }
    (products, properties)
}

/// The name and parameters of a representation of shape.
fn shape<'a>(instance: &Instance<'a>) -> Option<(&'a str, Params<'a>)> {
    let (name, params) = instance.parts().find(|(name, _)| is_shape(name))?;
    if params.clone().next().is_some() {
        return Some((name, params));
    }
    Some((name, instance.part("REPRESENTATION")?))
}

fn is_shape(name: &str) -> bool {
    match name {
        "REPRESENTATION"
        | "CONSTRUCTIVE_GEOMETRY_REPRESENTATION"
        | "SHAPE_REPRESENTATION_WITH_PARAMETERS" => true,
        "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION" => false,
        _ => name.ends_with("SHAPE_REPRESENTATION"),
    }
}
