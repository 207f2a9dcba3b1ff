// Triangles on the device and the layers they are drawn into: what methods in image space stand on.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu/raster.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <numeric>
#include <utility>

namespace eikonal::gpu {

Triangles::Triangles(Device& device, std::span<const float> vertices, std::span<const int> sizes,
                     std::span<const std::uint32_t> indices)
    : mVertices(device, static_cast<std::int64_t>(vertices.size_bytes()), vertices.data()),
      mIndices(device, static_cast<std::int64_t>(indices.size_bytes()), indices.data()),
      mIndexCount(static_cast<std::int64_t>(indices.size())) {
    glCreateVertexArrays(1, &mName);
    const int floats = std::accumulate(sizes.begin(), sizes.end(), 0);
    glVertexArrayVertexBuffer(mName, 0, mVertices.name(), 0, floats * 4);
    GLuint first = 0;
    for (GLuint k = 0; k < sizes.size(); ++k) {
        glEnableVertexArrayAttrib(mName, k);
        glVertexArrayAttribFormat(mName, k, sizes[k], GL_FLOAT, GL_FALSE, 4 * first);
        glVertexArrayAttribBinding(mName, k, 0);
        first += static_cast<GLuint>(sizes[k]);
    }
    glVertexArrayElementBuffer(mName, mIndices.name());
    device.check("allocating triangles");
}

Triangles::~Triangles() {
    if (mName != 0) glDeleteVertexArrays(1, &mName);
}

Triangles::Triangles(Triangles&& other) noexcept
    : mName(std::exchange(other.mName, 0)), mVertices(std::move(other.mVertices)),
      mIndices(std::move(other.mIndices)), mIndexCount(other.mIndexCount) {}

Triangles& Triangles::operator=(Triangles&& other) noexcept {
    std::swap(mName, other.mName);
    std::swap(mVertices, other.mVertices);
    std::swap(mIndices, other.mIndices);
    std::swap(mIndexCount, other.mIndexCount);
    return *this;
}

void Triangles::draw(const Part& part) const {
    if (part.count == 0) return;
    glBindVertexArray(mName);
    // Bounded pieces, since a draw counts its indices in 32 bits.
    const std::int64_t piece = 3 * (std::int64_t{1} << 26), end = 3 * (part.first + part.count);
    for (std::int64_t first = 3 * part.first; first < end; first += piece)
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(std::min(piece, end - first)),
                       GL_UNSIGNED_INT, reinterpret_cast<const void*>(first * 4));
    glBindVertexArray(0);
}

namespace {

GLenum internalOf(TexelFormat format) {
    return format == TexelFormat::r32f ? GL_R32F : GL_RGBA32F;
}

GLenum layoutOf(TexelFormat format) {
    return format == TexelFormat::r32f ? GL_RED : GL_RGBA;
}

} // namespace

std::int64_t Layers::bytesFor(int width, int height, int layers, int levels, TexelFormat format) {
    std::int64_t texels = 0;
    for (int level = 0; level < levels; ++level)
        texels += std::int64_t{std::max(width >> level, 1)} * std::max(height >> level, 1);
    return texels * layers * bytesOf(format);
}

Layers::Layers(Device& device, int width, int height, int layers, int levels, TexelFormat format)
    : mDevice(&device), mWidth(width), mHeight(height),
      mBytes(bytesFor(width, height, layers, levels, format)), mFormat(format) {
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &mName);
    glTextureStorage3D(mName, levels, internalOf(format), width, height, layers);
    glTextureParameteri(mName, GL_TEXTURE_MIN_FILTER,
                        levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTextureParameteri(mName, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(mName, axis, GL_CLAMP_TO_EDGE);
    device.check("allocating layers");
    device.account(mBytes);
}

Layers::~Layers() {
    if (mName == 0) return;
    glDeleteTextures(1, &mName);
    mDevice->account(-mBytes);
}

Layers::Layers(Layers&& other) noexcept
    : mDevice(other.mDevice), mName(std::exchange(other.mName, 0)), mWidth(other.mWidth),
      mHeight(other.mHeight), mBytes(other.mBytes), mFormat(other.mFormat) {}

Layers& Layers::operator=(Layers&& other) noexcept {
    std::swap(mDevice, other.mDevice);
    std::swap(mName, other.mName);
    std::swap(mWidth, other.mWidth);
    std::swap(mHeight, other.mHeight);
    std::swap(mBytes, other.mBytes);
    std::swap(mFormat, other.mFormat);
    return *this;
}

void Layers::clear(int layer) {
    glClearTexSubImage(mName, 0, 0, 0, layer, mWidth, mHeight, 1, layoutOf(mFormat), GL_FLOAT,
                       nullptr);
}

void Layers::makeLevels() {
    glGenerateTextureMipmap(mName);
}

void Layers::bindSampler(unsigned unit) const {
    glBindTextureUnit(unit, mName);
}

void Layers::bindImage(unsigned unit) const {
    glBindImageTexture(unit, mName, 0, GL_TRUE, 0, GL_READ_WRITE, internalOf(mFormat));
}

void Layers::download(void* data, std::int64_t bytes) const {
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glGetTextureImage(mName, 0, layoutOf(mFormat), GL_FLOAT, static_cast<GLsizei>(bytes), data);
}

Canvas::Canvas(Device& device, int width, int height) : mWidth(width), mHeight(height) {
    glCreateFramebuffers(1, &mName);
    glCreateRenderbuffers(1, &mDepth);
    glNamedRenderbufferStorage(mDepth, GL_DEPTH_COMPONENT32F, width, height);
    glNamedFramebufferRenderbuffer(mName, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, mDepth);
    glCreateFramebuffers(1, &mOverall);
    glNamedFramebufferRenderbuffer(mOverall, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, mDepth);
    glCreateVertexArrays(1, &mNoVertices);
    glCreateQueries(GL_ANY_SAMPLES_PASSED, 1, &mQuery);
    device.check("allocating a canvas");
}

Canvas::~Canvas() {
    if (mName == 0) return;
    glDeleteQueries(1, &mQuery);
    glDeleteVertexArrays(1, &mNoVertices);
    glDeleteFramebuffers(1, &mOverall);
    glDeleteRenderbuffers(1, &mDepth);
    glDeleteFramebuffers(1, &mName);
}

Canvas::Canvas(Canvas&& other) noexcept
    : mName(std::exchange(other.mName, 0)), mDepth(other.mDepth), mQuery(other.mQuery),
      mOverall(other.mOverall), mNoVertices(other.mNoVertices), mWidth(other.mWidth),
      mHeight(other.mHeight) {}

Canvas& Canvas::operator=(Canvas&& other) noexcept {
    std::swap(mName, other.mName);
    std::swap(mDepth, other.mDepth);
    std::swap(mQuery, other.mQuery);
    std::swap(mOverall, other.mOverall);
    std::swap(mNoVertices, other.mNoVertices);
    std::swap(mWidth, other.mWidth);
    std::swap(mHeight, other.mHeight);
    return *this;
}

void Canvas::begin(const std::vector<Target>& targets, bool furthest) {
    // A shader may read other layers of its targets.
    glTextureBarrier();
    std::vector<GLenum> attachments;
    for (const Target& target : targets) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size());
        glNamedFramebufferTextureLayer(mName, attachment, target.layers->name(), 0, target.layer);
        attachments.push_back(attachment);
    }
    glNamedFramebufferTexture(mName, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()),
                              0, 0);
    glNamedFramebufferDrawBuffers(mName, static_cast<GLsizei>(attachments.size()),
                                  attachments.data());
    const float depth = furthest ? 1.0f : 0.0f; // 0 is far
    glClearNamedFramebufferfv(mName, GL_DEPTH, 0, &depth);
    const float none[4] = {};
    for (size_t k = 0; k < attachments.size(); ++k)
        glClearNamedFramebufferfv(mName, GL_COLOR, static_cast<GLint>(k), none);
    glBindFramebuffer(GL_FRAMEBUFFER, mName);
    glViewport(0, 0, mWidth, mHeight);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glFrontFace(GL_CW); // y is down
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(furthest ? GL_LESS : GL_GREATER);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, mQuery);
}

void Canvas::draw(const Program& program, const Triangles& triangles, Faces faces,
                  const Triangles::Part& part) {
    if (faces == Faces::both) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
        glCullFace(faces == Faces::front ? GL_BACK : GL_FRONT);
    }
    program.use();
    triangles.draw(part);
}

bool Canvas::end(bool ask) {
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LESS);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (!ask) return true;
    GLuint any = 0;
    glGetQueryObjectuiv(mQuery, GL_QUERY_RESULT, &any);
    return any != 0;
}

void Canvas::addWhere(bool covered, const Program& program, const Texture& target) const {
    glNamedFramebufferTexture(mOverall, GL_COLOR_ATTACHMENT0, target.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, mOverall);
    glViewport(0, 0, mWidth, mHeight);
    glBindVertexArray(mNoVertices);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    // Bare is what depth was cleared to, 0.
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glDepthRange(0, 0);
    glDepthFunc(covered ? GL_LESS : GL_EQUAL);
    program.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthFunc(GL_LESS);
    glDepthRange(0, 1);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

} // namespace eikonal::gpu
