//! Numbers and texts as bytes, and back. Lengths stand before what they are lengths of; numbers are little-endian.

/// Bytes that do not say what they should. The cache is not used then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corrupt;

/// Writes bytes.
#[derive(Clone, Debug, Default)]
pub struct Encoder {
    bytes: Vec<u8>,
}

/// Reads what an [`Encoder`] wrote, without copying texts.
#[derive(Clone, Copy, Debug)]
pub struct Decoder<'a> {
    bytes: &'a [u8],
}

impl Encoder {
    /// What was written.
    pub fn finish(self) -> Vec<u8> {
        self.bytes
    }

    /// Adds a number.
    pub fn u64(&mut self, number: u64) {
        self.bytes.extend(number.to_le_bytes());
    }

    /// Adds a number.
    pub fn u32(&mut self, number: u32) {
        self.bytes.extend(number.to_le_bytes());
    }

    /// Adds a small number.
    pub fn u8(&mut self, number: u8) {
        self.bytes.push(number);
    }

    /// Adds how many of something follow. So many that the number has no room are refused when they are read: the result is made anew.
    pub fn count(&mut self, count: usize) {
        self.u32(u32::try_from(count).unwrap_or(u32::MAX));
    }

    /// Adds bytes whose length is known.
    pub fn raw(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// Adds bytes with their length.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.count(bytes.len());
        self.raw(bytes);
    }

    /// Adds a text with its length.
    pub fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
    }

    /// Adds whether there is something, and it.
    pub fn option<T>(&mut self, value: Option<T>, mut encode: impl FnMut(&mut Self, T)) {
        self.u8(u8::from(value.is_some()));
        if let Some(value) = value {
            encode(self, value);
        }
    }

    /// Adds how many there are, and each.
    pub fn list<T>(
        &mut self,
        values: impl ExactSizeIterator<Item = T>,
        mut encode: impl FnMut(&mut Self, T),
    ) {
        self.count(values.len());
        for value in values {
            encode(self, value);
        }
    }
}

impl<'a> Decoder<'a> {
    /// Begins with the first byte.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// Whether everything was read.
    pub fn is_at_end(&self) -> bool {
        self.bytes.is_empty()
    }

    /// The next number.
    ///
    /// # Errors
    /// When the bytes end, here and below.
    pub fn u64(&mut self) -> Result<u64, Corrupt> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    /// The next number.
    ///
    /// # Errors
    /// As above.
    pub fn u32(&mut self) -> Result<u32, Corrupt> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    /// The next small number.
    ///
    /// # Errors
    /// As above.
    pub fn u8(&mut self) -> Result<u8, Corrupt> {
        Ok(self.array::<1>()?[0])
    }

    /// How many of something follow.
    ///
    /// # Errors
    /// As above; also when there are more than bytes are left, each being a byte at least.
    pub fn count(&mut self) -> Result<usize, Corrupt> {
        let count = self.u32()? as usize;
        if count > self.bytes.len() { Err(Corrupt) } else { Ok(count) }
    }

    /// Bytes whose number is known.
    ///
    /// # Errors
    /// As above.
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], Corrupt> {
        let (first, rest) = self.bytes.split_first_chunk().ok_or(Corrupt)?;
        self.bytes = rest;
        Ok(*first)
    }

    /// Bytes with their length.
    ///
    /// # Errors
    /// As above.
    pub fn bytes(&mut self) -> Result<&'a [u8], Corrupt> {
        let length = self.count()?;
        let (first, rest) = self.bytes.split_at_checked(length).ok_or(Corrupt)?;
        self.bytes = rest;
        Ok(first)
    }

    /// A text with its length.
    ///
    /// # Errors
    /// As above; also when it is no UTF-8.
    pub fn text(&mut self) -> Result<&'a str, Corrupt> {
        std::str::from_utf8(self.bytes()?).map_err(|_| Corrupt)
    }

    /// What [`Encoder::option`] wrote.
    ///
    /// # Errors
    /// As above.
    pub fn option<T>(
        &mut self,
        decode: impl FnOnce(&mut Self) -> Result<T, Corrupt>,
    ) -> Result<Option<T>, Corrupt> {
        match self.u8()? {
            0 => Ok(None),
            1 => decode(self).map(Some),
            _ => Err(Corrupt),
        }
    }

    /// What [`Encoder::list`] wrote.
    ///
    /// # Errors
    /// As above.
    pub fn list<T>(
        &mut self,
        mut decode: impl FnMut(&mut Self) -> Result<T, Corrupt>,
    ) -> Result<Vec<T>, Corrupt> {
        (0..self.count()?).map(|_| decode(self)).collect()
    }
}
