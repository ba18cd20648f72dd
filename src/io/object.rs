//! JSON objects that keep keys unknown to them, or to their version of the file.
//!
//! Left alone, serde passes over unknown keys, and takes an array for a struct too, its elements
//! in the order in which the program declares the fields.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{DeserializeSeed, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer, forward_to_deserialize_any};
use serde_json::value::{RawValue, to_raw_value};

use crate::document::Extras;

/// A version of the project file.
pub(super) trait Version {
    /// Its number in the file.
    const NUMBER: u64;

    /// The keys that later versions added: in this one they are unknown.
    const LATER_KEYS: &'static [&'static str];
}

/// A struct that is read from a JSON object of a version of the file, never from an array, with the
/// keys that it does not have. It is written with these after its own.
#[derive(Serialize)]
#[serde(bound = "T: Serialize")]
pub(super) struct Object<T, V> {
    /// The struct.
    #[serde(flatten)]
    pub value: T,
    /// What else is in the object.
    #[serde(flatten, serialize_with = "serialize_extras")]
    pub extras: Extras,
    #[serde(skip)]
    version: PhantomData<V>,
}

impl<T, V> Object<T, V> {
    /// Begin without further keys.
    pub(super) fn new(value: T) -> Self {
        Self {
            value,
            extras: Extras::default(),
            version: PhantomData,
        }
    }

    /// Set the further keys.
    pub(super) fn with_extras(self, extras: Extras) -> Self {
        Self { extras, ..self }
    }
}

/// Unknown keys that are not kept.
#[derive(Default)]
pub(super) struct UnknownKeys(pub Vec<String>);

impl UnknownKeys {
    /// Take an object without its unknown keys, and remember these.
    pub(super) fn strip<T, V>(&mut self, object: Option<Object<T, V>>) -> Option<T> {
        let object = object?;
        let keys = object.extras.iter().map(|(key, _)| key.to_owned());
        self.0.extend(keys);
        Some(object.value)
    }
}

impl<'de, T: Deserialize<'de>, V: Version> Deserialize<'de> for Object<T, V> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut extras = Extras::default();
        let value = T::deserialize(ObjectDeserializer {
            inner: deserializer,
            later: V::LATER_KEYS,
            extras: &mut extras,
        })?;
        Ok(Self::new(value).with_extras(extras))
    }
}

/// Texts that are no JSON, which no reader makes, are written as strings.
fn serialize_extras<S: Serializer>(extras: &Extras, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(extras.iter().map(|(key, text)| {
        let raw = RawValue::from_string(text.to_owned());
        (key, raw.or_else(|_| to_raw_value(text)).ok())
    }))
}

struct ObjectDeserializer<'a, D> {
    inner: D,
    /// The keys that are unknown though the struct has fields for them.
    later: &'static [&'static str],
    extras: &'a mut Extras,
}

impl<'de, D: Deserializer<'de>> Deserializer<'de> for ObjectDeserializer<'_, D> {
    type Error = D::Error;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, D::Error> {
        self.inner.deserialize_map(ObjectVisitor {
            visitor,
            fields,
            later: self.later,
            extras: self.extras,
        })
    }

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, D::Error> {
        self.inner.deserialize_any(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option
        unit unit_struct newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

struct ObjectVisitor<'a, V> {
    visitor: V,
    fields: &'static [&'static str],
    later: &'static [&'static str],
    extras: &'a mut Extras,
}

impl<'de, V: Visitor<'de>> Visitor<'de> for ObjectVisitor<'_, V> {
    type Value = V::Value;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.visitor.expecting(formatter)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<V::Value, A::Error> {
        self.visitor.visit_map(KnownKeys {
            map,
            fields: self.fields,
            later: self.later,
            extras: self.extras,
        })
    }
}

/// The entries that a struct has fields for; the others become extras on the way.
struct KnownKeys<'a, A> {
    map: A,
    fields: &'static [&'static str],
    later: &'static [&'static str],
    extras: &'a mut Extras,
}

impl<'de, A: MapAccess<'de>> MapAccess<'de> for KnownKeys<'_, A> {
    type Error = A::Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, A::Error> {
        while let Some(key) = self.map.next_key::<String>()? {
            let is_later = self.later.contains(&key.as_str());
            let mut fields = self.fields.iter().filter(|_| !is_later);
            if let Some(field) = fields.find(|field| **field == key) {
                return seed.deserialize(field.into_deserializer()).map(Some);
            }
            let value: Box<RawValue> = self.map.next_value()?;
            self.extras.push(key, value.get());
        }
        Ok(None)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, A::Error> {
        self.map.next_value_seed(seed)
    }
}
