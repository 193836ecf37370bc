// The value number `at` of an engine::TableTexture.
vec4 table_value(sampler2D table, int at) { return texelFetch(table, ivec2(at & 2047, at >> 11), 0); }
