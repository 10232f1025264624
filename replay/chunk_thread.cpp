#include "replay/chunk_thread.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

namespace reprise::replay {

namespace {

/// Chunks waiting or being written. Each is about 0.7 MB with 100 cars.
constexpr std::size_t chunks_under_way = 4;

}  // namespace

struct ChunkThread::Shared {
    TraceFile& file;
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::unique_ptr<PendingChunk>> full;
    std::vector<std::unique_ptr<PendingChunk>> empty;
    std::size_t under_way = 0;
    bool ending = false;
    std::atomic<bool> failed = false;
    std::exception_ptr error;  ///< set before `failed`, never changed after
    std::thread thread;

    explicit Shared(TraceFile& trace) : file(trace) {}

    /// The thread. After an error it only empties the queue, so that nobody waits for ever.
    void run() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [&] { return !full.empty() || ending; });
            if (full.empty())
                return;
            std::unique_ptr<PendingChunk> chunk = std::move(full.front());
            full.pop_front();
            lock.unlock();
            write(*chunk);
            chunk->clear();
            lock.lock();
            empty.push_back(std::move(chunk));
            --under_way;
            changed.notify_all();
        }
    }

    void write(const PendingChunk& chunk) noexcept {
        if (failed)
            return;
        try {
            file.chunk(chunk);
        } catch (...) {
            error = std::current_exception();
            failed = true;
        }
    }

    void join() {
        {
            const std::lock_guard lock(mutex);
            ending = true;
        }
        changed.notify_all();
        if (thread.joinable())
            thread.join();
    }
};

ChunkThread::ChunkThread(TraceFile& file) : shared_(std::make_unique<Shared>(file)) {
    shared_->thread = std::thread([shared = shared_.get()] { shared->run(); });
}

ChunkThread::~ChunkThread() {
    shared_->join();
}

void ChunkThread::exchange(std::unique_ptr<PendingChunk>& chunk) {
    check();
    std::unique_lock lock(shared_->mutex);
    shared_->changed.wait(lock, [&] { return shared_->under_way < chunks_under_way; });
    ++shared_->under_way;
    shared_->full.push_back(std::move(chunk));
    if (shared_->empty.empty()) {
        chunk = std::make_unique<PendingChunk>();
    } else {
        chunk = std::move(shared_->empty.back());
        shared_->empty.pop_back();
    }
    lock.unlock();
    shared_->changed.notify_all();
}

void ChunkThread::check() const {
    if (shared_->failed)
        std::rethrow_exception(shared_->error);
}

void ChunkThread::finish() {
    shared_->join();
    check();
}

}  // namespace reprise::replay
