// Buffers, textures and timers on the device, released by their destructors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/resources.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <utility>

namespace eikonal::gpu {

Buffer::Buffer(Device& device, std::int64_t bytes, InPlace read) : mDevice(&device), mBytes(bytes) {
    allocate(nullptr, read == InPlace::yes ? GL_MAP_READ_BIT : 0u);
}

Buffer::Buffer(Device& device, std::int64_t bytes, const void* data)
    : mDevice(&device), mBytes(bytes) {
    allocate(data, 0);
}

void Buffer::allocate(const void* data, unsigned flags) {
    glCreateBuffers(1, &mName);
    // A buffer of no bytes is an error in OpenGL; an empty list is none here.
    glNamedBufferStorage(mName, std::max<std::int64_t>(mBytes, 16), mBytes > 0 ? data : nullptr,
                         GL_DYNAMIC_STORAGE_BIT | flags);
    mDevice->check("allocating a buffer");
    mDevice->account(mBytes);
}

Buffer::~Buffer() {
    if (mName == 0) return;
    glDeleteBuffers(1, &mName);
    mDevice->account(-mBytes);
}

Buffer::Buffer(Buffer&& other) noexcept
    : mDevice(other.mDevice), mName(std::exchange(other.mName, 0)), mBytes(other.mBytes) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(mDevice, other.mDevice);
    std::swap(mName, other.mName);
    std::swap(mBytes, other.mBytes);
    return *this;
}

void Buffer::upload(const void* data, std::int64_t bytes, std::int64_t offset) {
    glNamedBufferSubData(mName, offset, bytes, data);
}

void Buffer::download(void* data, std::int64_t bytes, std::int64_t offset) const {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(mName, offset, bytes, data);
}

const void* Buffer::map() const {
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    const void* content = glMapNamedBufferRange(mName, 0, mBytes, GL_MAP_READ_BIT);
    mDevice->check("reading a buffer in place");
    return content;
}

void Buffer::unmap() const {
    glUnmapNamedBuffer(mName);
}

void Buffer::clear() {
    glClearNamedBufferData(mName, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void Buffer::copyFrom(const Buffer& other, std::int64_t bytes, std::int64_t offset) {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(other.mName, mName, offset, offset, bytes);
}

void Buffer::bindStorage(unsigned binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, mName);
}

void Buffer::bindUniform(unsigned binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, mName);
}

namespace {

struct FormatFacts {
    GLenum internal, layout, type;
    int components, bytes;
};

FormatFacts facts(TexelFormat format) {
    switch (format) {
    case TexelFormat::r32f:
        return {GL_R32F, GL_RED, GL_FLOAT, 1, 4};
    case TexelFormat::rg32f:
        return {GL_RG32F, GL_RG, GL_FLOAT, 2, 8};
    case TexelFormat::rgba16f:
        return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 4, 8};
    case TexelFormat::rgba32f:
        return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16};
    case TexelFormat::r8ui:
        return {GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1, 1};
    case TexelFormat::r32ui:
        return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, 4};
    case TexelFormat::rg32ui:
        return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 2, 8};
    case TexelFormat::rgba32ui:
        return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, 16};
    }
    return {};
}

} // namespace

int componentsOf(TexelFormat format) {
    return facts(format).components;
}

int bytesOf(TexelFormat format) {
    return facts(format).bytes;
}

Texture::Texture(Device& device, glm::ivec3 size, TexelFormat format, Filter filter)
    : mDevice(&device), mSize(size), mFormat(format) {
    const bool flat = size.z == 0;
    glCreateTextures(flat ? GL_TEXTURE_2D : GL_TEXTURE_3D, 1, &mName);
    if (flat)
        glTextureStorage2D(mName, 1, facts(format).internal, size.x, size.y);
    else
        glTextureStorage3D(mName, 1, facts(format).internal, size.x, size.y, size.z);
    const GLint filtering = filter == Filter::linear ? GL_LINEAR : GL_NEAREST;
    glTextureParameteri(mName, GL_TEXTURE_MIN_FILTER, filtering);
    glTextureParameteri(mName, GL_TEXTURE_MAG_FILTER, filtering);
    for (GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(mName, axis, GL_CLAMP_TO_EDGE);
    device.check("allocating a texture");
    device.account(bytes());
}

Texture::~Texture() {
    if (mName == 0) return;
    glDeleteTextures(1, &mName);
    mDevice->account(-bytes());
}

Texture::Texture(Texture&& other) noexcept
    : mDevice(other.mDevice), mName(std::exchange(other.mName, 0)), mSize(other.mSize),
      mFormat(other.mFormat) {}

Texture& Texture::operator=(Texture&& other) noexcept {
    std::swap(mDevice, other.mDevice);
    std::swap(mName, other.mName);
    std::swap(mSize, other.mSize);
    std::swap(mFormat, other.mFormat);
    return *this;
}

std::int64_t Texture::bytes() const {
    return std::int64_t{mSize.x} * mSize.y * std::max(mSize.z, 1) * bytesOf(mFormat);
}

void Texture::upload(const void* data) {
    if (mSize.z == 0)
        uploadRows(0, mSize.y, data);
    else
        uploadSlices(0, mSize.z, data);
}

void Texture::uploadSlices(int slice, int count, const void* data) {
    const FormatFacts format = facts(mFormat);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(mName, 0, 0, 0, slice, mSize.x, mSize.y, count, format.layout, format.type,
                        data);
}

void Texture::uploadRows(int row, int count, const void* data) {
    const FormatFacts format = facts(mFormat);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(mName, 0, 0, row, mSize.x, count, format.layout, format.type, data);
}

void Texture::download(void* data, std::int64_t bytes) const {
    const FormatFacts format = facts(mFormat);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(mName, 0, format.layout, format.type, static_cast<GLsizei>(bytes), data);
}

void Texture::clear() {
    fill(nullptr);
}

void Texture::fill(const void* texel) {
    const FormatFacts format = facts(mFormat);
    glClearTexImage(mName, 0, format.layout, format.type, texel);
}

void Texture::bindSampler(unsigned unit) const {
    glBindTextureUnit(unit, mName);
}

void Texture::bindImage(unsigned unit) const {
    glBindImageTexture(unit, mName, 0, GL_TRUE, 0, GL_READ_WRITE, facts(mFormat).internal);
}

void barrier() {
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

void finish() {
    glFinish();
}

Profiler::~Profiler() {
    for (Pending& pending : mPending) glDeleteQueries(2, pending.queries);
}

void Profiler::begin(const std::string& pass) {
    Pending pending;
    pending.pass = pass;
    glGenQueries(2, pending.queries);
    glQueryCounter(pending.queries[0], GL_TIMESTAMP);
    mPending.push_back(pending);
    mBegin = std::chrono::steady_clock::now();
}

void Profiler::end() {
    glQueryCounter(mPending.back().queries[1], GL_TIMESTAMP);
    mPending.back().cpuMs = millisecondsSince(mBegin);
}

void Profiler::collect() {
    for (Pending& pending : mPending) {
        GLuint64 from = 0, to = 0;
        glGetQueryObjectui64v(pending.queries[0], GL_QUERY_RESULT, &from);
        glGetQueryObjectui64v(pending.queries[1], GL_QUERY_RESULT, &to);
        glDeleteQueries(2, pending.queries);
        mStats.addPass(pending.pass, static_cast<double>(to - from) * 1e-6, pending.cpuMs);
    }
    mPending.clear();
}

double millisecondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

} // namespace eikonal::gpu
