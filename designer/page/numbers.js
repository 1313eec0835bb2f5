// Numbers as people write them: 1.5 and 1,5, but no separator of thousands, which in one country is the other's decimal mark.

/** The number in `text`, of things that are counted if it `isWhole`; NaN for no text. An error says what to write instead. */
export function parse(text, isWhole) {
  const plain = text.trim().replace(/^[−–]/, '-');
  if (!plain) return NaN;
  const marks = plain.replace(/[^.,]/g, '');
  const refuse = (words) => {
    throw new Error(`“${text.trim()}” ${words}`);
  };
  if (/\d[\s'’_]\d/.test(plain) || marks.length > 1) {
    // The last mark is that of the decimals if it stands alone; whatever else parts digits parts thousands.
    const last = marks.at(-1);
    const mark = marks.split(last).length === 2 ? plain.lastIndexOf(last) : plain.length;
    const digits = plain.slice(0, mark).replace(/[.,\s'’_]/g, '') + plain.slice(mark).replace(',', '.');
    refuse(`has a separator of thousands: write ${digits}`);
  }
  if (/^[+-]?[1-9]\d{0,2},\d{3}$/.test(plain) || (isWhole && /^[+-]?[1-9]\d{0,2}\.\d{3}$/.test(plain))) {
    refuse(`may be ${Number(plain.replace(',', '.'))} or ${plain.replace(/[.,]/, '')}: write one of them`);
  }
  const number = plain.replace(',', '.');
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(number)) refuse('is no number');
  return Number(number);
}
