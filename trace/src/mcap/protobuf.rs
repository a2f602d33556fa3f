//! This file reads messages in Protocol Buffers by the descriptors that their file carries.

use prost_reflect::{DescriptorPool, DynamicMessage, MessageDescriptor, ReflectMessage, Value};

use super::flat::Flat;
use super::guard::guarded;
use super::topics::{Schema, short};

/// The largest message that is read, bytes: taken apart, it needs many times its size.
const LARGEST_MESSAGE: usize = 1 << 20;
/// The largest set of descriptors that is read, bytes.
const LARGEST_SCHEMA: usize = 4 << 20;

/// A reader for the messages of one type.
#[derive(Debug)]
pub(super) struct ProtobufReader {
    descriptor: MessageDescriptor,
}

impl ProtobufReader {
    /// Prepares to read the messages that a schema, a set of file descriptors, describes.
    pub(super) fn new(schema: &Schema) -> Result<ProtobufReader, String> {
        if schema.data.len() > LARGEST_SCHEMA {
            return Err(format!(
                "its descriptors take more than {LARGEST_SCHEMA} bytes"
            ));
        }
        // The crate panics where a damaged set has an error to report at a place that it does not hold.
        let pool = guarded(|| {
            DescriptorPool::decode(schema.data.as_slice())
                .map_err(|_| "its schema is no set of file descriptors".to_string())
        })?;
        let descriptor = pool.get_message_by_name(&schema.name);
        let descriptor = descriptor
            .ok_or_else(|| format!("its schema does not describe `{}`", short(&schema.name)))?;
        Ok(ProtobufReader { descriptor })
    }

    /// Takes the numbers of a message out; `named` keeps their places too.
    pub(super) fn read(&self, data: &[u8], flat: &mut Flat, named: bool) -> Result<(), String> {
        flat.begin(named);
        if data.len() > LARGEST_MESSAGE {
            return Err(format!(
                "the message takes more than {LARGEST_MESSAGE} bytes"
            ));
        }
        let message = DynamicMessage::decode(self.descriptor.clone(), data)
            .map_err(|_| "the message contradicts its descriptors".to_string())?;
        fields(&message, flat);
        Ok(())
    }
}

fn fields(message: &DynamicMessage, flat: &mut Flat) {
    for field in message.descriptor().fields() {
        // A message that is absent has no numbers; a number that is absent is zero, as the format says.
        let present = !field.supports_presence() || message.has_field(&field);
        flat.depends_on_count(usize::from(present));
        if present {
            flat.field(field.name());
            value(&message.get_field(&field), false, flat);
            flat.up();
        }
    }
}

fn value(value: &Value, element: bool, flat: &mut Flat) {
    match value {
        Value::Bool(truth) => flat.number(f64::from(u8::from(*truth))),
        Value::I32(n) | Value::EnumNumber(n) => flat.number(f64::from(*n)),
        Value::I64(n) => flat.number(*n as f64),
        Value::U32(n) => flat.number(f64::from(*n)),
        Value::U64(n) => flat.number(*n as f64),
        Value::F32(x) => flat.number(f64::from(*x)),
        Value::F64(x) => flat.number(*x),
        Value::String(text) if element => flat.element_text(text.as_bytes()),
        Value::Message(message) => fields(message, flat),
        Value::List(list) => {
            flat.depends_on_count(list.len());
            for (index, item) in list.iter().take(flat.elements).enumerate() {
                flat.element(index);
                self::value(item, true, flat);
                flat.up();
            }
        }
        Value::String(_) | Value::Bytes(_) | Value::Map(_) => {}
    }
}
